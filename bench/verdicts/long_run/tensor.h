/* The tensor model as the paper prints it, eqs. (V), (S), (U), with indices and nothing simplified.
   Written from the paper; shares no line and no coefficient table with motiform. */
#ifndef TENSOR_H
#define TENSOR_H

enum { SHAPE = 6, PARAMETERS = 21 };

/* In the order of `motiform models tensor`. */
typedef struct {
    double gamma, kappa2, kappa3;
    double a1, a2, a3, a4, a5, a6;
    double b1, b2, b3, b4, b5, b6;
    double d1, d2, d3, d4, d5, d6;
} Parameters;

#define FOR(i) for (int i = 0; i < 2; i++)

/* c = (v1, v2, S11, S12, U111, U222); its rate of change in dc. */
static inline void rate(const Parameters *p, const double *c, double *dc)
{
    const double v[2] = {c[0], c[1]};
    const double S[2][2] = {{c[2], c[3]}, {c[3], -c[2]}};
    const double U[2][2][2] = {{{c[4], -c[5]}, {-c[5], -c[4]}}, {{-c[5], -c[4]}, {-c[4], c[5]}}};
    const double vv = v[0] * v[0] + v[1] * v[1];
    double SS = 0, UU = 0, Sv[2] = {0, 0}, SSv[2] = {0, 0};
    FOR(i) FOR(j) { SS += S[i][j] * S[i][j]; Sv[i] += S[i][j] * v[j]; }
    FOR(i) FOR(j) SSv[i] += S[i][j] * Sv[j];
    FOR(i) FOR(j) FOR(k) UU += U[i][j][k] * U[i][j][k];

    FOR(i) {
        double dv = p->gamma * v[i] - vv * v[i] - p->a4 * SS * v[i] - p->a5 * UU * v[i];
        dv -= p->a1 * Sv[i];
        FOR(j) FOR(k) {
            dv -= p->a2 * U[i][j][k] * v[j] * v[k];
            dv -= p->a3 * U[i][j][k] * S[j][k];
            FOR(l) dv += p->a6 * S[i][l] * S[k][j] * U[l][k][j];
        }
        dc[i] = dv;
    }
    double dS[2][2];
    FOR(i) FOR(j) {
        double s = -p->kappa2 * S[i][j] + p->b1 * (v[i] * v[j] - (i == j ? 0.5 * vv : 0.0));
        s -= (p->b3 * SS + p->b4 * vv + p->b5 * UU) * S[i][j];
        FOR(k) s += (p->b2 * v[k] + p->b6 * Sv[k]) * U[i][j][k];
        dS[i][j] = s;
    }
    dc[2] = dS[0][0];
    dc[3] = dS[0][1];
    /* The components 111 and 222: i = j = k = a, so every delta is 1 and the sums have three equal terms. */
    FOR(a) {
        double u = -(p->kappa3 + p->d3 * UU + p->d4 * vv + p->d5 * SS) * U[a][a][a];
        u += p->d1 * (v[a] * v[a] * v[a] - 0.25 * vv * 3 * v[a]);
        u += p->d2 / 3 * (3 * S[a][a] * v[a] - 0.5 * 3 * Sv[a]);
        u += 2 * p->d6 / 3 * (3 * S[a][a] * Sv[a] - 0.5 * 3 * SSv[a]);
        dc[4 + a] = u;
    }
}

#endif
