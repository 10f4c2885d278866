/* The active cell, eqs. (C), (VEL) and (CLOSE), in Fourier components of phi: written from the equations, with Cox and Matthews'
   ETDRK4 at fixed steps (coefficients by Kassam and Trefethen's contour). Shares no line with motiform. */
#ifndef CELL_H
#define CELL_H
#include <complex.h>
#include <math.h>
#include <string.h>

typedef double complex Mode;

enum { M = 21, CLOSING = 8, POINTS = 128, UNKNOWNS = 2 * CLOSING + 2 };

/* Index n = 1 .. M; index 0 is unused. phi = sum over n of phi_n exp(i n k s) + c.c. */
typedef Mode Shape[M + 1];

typedef struct {
    double length, k, h;
    double whole[M + 1], half[M + 1], q[M + 1], f1[M + 1], f2[M + 1], f3[M + 1];
} Cell;

static double growth_rate(double k) { return k * k * k * k * (1 - k * k); }

/* The coefficients for steps of length h. */
static void set_step(Cell *c, double h)
{
    enum { CIRCLE = 64 };
    c->h = h;
    for (int n = 1; n <= M; n++) {
        const double l = h * growth_rate(c->k * n);
        c->whole[n] = exp(l);
        c->half[n] = exp(l / 2);
        double complex q = 0, f1 = 0, f2 = 0, f3 = 0;
        for (int j = 0; j < CIRCLE; j++) {
            const double complex z = l + cexp(2 * M_PI * I * (j + 0.5) / CIRCLE);
            q += (cexp(z / 2) - 1) / z;
            f1 += (-4 - z + cexp(z) * (4 - 3 * z + z * z)) / (z * z * z);
            f2 += (2 + z + cexp(z) * (z - 2)) / (z * z * z);
            f3 += (-4 - 3 * z - z * z + cexp(z) * (4 - z)) / (z * z * z);
        }
        c->q[n] = h * creal(q) / CIRCLE;
        c->f1[n] = h * creal(f1) / CIRCLE;
        c->f2[n] = h * creal(f2) / CIRCLE;
        c->f3[n] = h * creal(f3) / CIRCLE;
    }
}

/* -phi_ss phi_sss = -(1/2) d/ds (phi_ss)^2: component n is -(i n k / 2) sum over p + q = n of (phi_ss)_p (phi_ss)_q. */
static void quadratic(const Cell *c, const Shape u, Shape out)
{
    Shape w;
    for (int n = 1; n <= M; n++) w[n] = -(c->k * n) * (c->k * n) * u[n];
    for (int n = 1; n <= M; n++) {
        Mode sum = 0;
        for (int p = 1; p < n; p++) sum += w[p] * w[n - p];
        for (int p = n + 1; p <= M; p++) sum += 2 * w[p] * conj(w[p - n]);
        out[n] = -0.5 * I * (c->k * n) * sum;
    }
}

static void cell_rate(const Cell *c, const Shape u, Shape du)
{
    quadratic(c, u, du);
    for (int n = 1; n <= M; n++) du[n] += growth_rate(c->k * n) * u[n];
}

static void cell_step(const Cell *c, Shape u)
{
    Shape nu, a, na, b, nb, d, nd;
    quadratic(c, u, nu);
    for (int n = 1; n <= M; n++) a[n] = c->half[n] * u[n] + c->q[n] * nu[n];
    quadratic(c, a, na);
    for (int n = 1; n <= M; n++) b[n] = c->half[n] * u[n] + c->q[n] * na[n];
    quadratic(c, b, nb);
    for (int n = 1; n <= M; n++) d[n] = c->half[n] * a[n] + c->q[n] * (2 * nb[n] - nu[n]);
    quadratic(c, d, nd);
    for (int n = 1; n <= M; n++)
        u[n] = c->whole[n] * u[n] + c->f1[n] * nu[n] + 2 * c->f2[n] * (na[n] + nb[n]) + c->f3[n] * nd[n];
}

/* Solves a x = b in place by elimination with pivots. */
static void eliminate(double a[UNKNOWNS][UNKNOWNS], double *b)
{
    for (int i = 0; i < UNKNOWNS; i++) {
        int best = i;
        for (int r = i + 1; r < UNKNOWNS; r++)
            if (fabs(a[r][i]) > fabs(a[best][i])) best = r;
        for (int j = 0; j < UNKNOWNS; j++) { const double t = a[i][j]; a[i][j] = a[best][j]; a[best][j] = t; }
        const double t = b[i]; b[i] = b[best]; b[best] = t;
        for (int r = i + 1; r < UNKNOWNS; r++) {
            const double f = a[r][i] / a[i][i];
            for (int j = i; j < UNKNOWNS; j++) a[r][j] -= f * a[i][j];
            b[r] -= f * b[i];
        }
    }
    for (int i = UNKNOWNS - 1; i >= 0; i--) {
        for (int j = i + 1; j < UNKNOWNS; j++) b[i] -= a[i][j] * b[j];
        b[i] /= a[i][i];
    }
}

/* The velocity (VEL), alpha2 = 0, alpha3 = -4e-4 L, with the normals of the closed boundary: least sum |eps_n|^2 n^8 / 2 subject to
   (CLOSE), eps of 8 modes, by Newton's method on the Lagrange conditions from eps = -(mode 1). As vx + i vy. */
static Mode cell_velocity(const Cell *c, const Shape u)
{
    static double cosine[CLOSING][POINTS], sine[CLOSING][POINTS];
    static Mode wave[M + 1][POINTS];
    if (cosine[0][0] == 0)
        for (int j = 0; j < POINTS; j++)
            for (int n = 1; n <= M; n++) {
                wave[n][j] = cexp(2 * M_PI * I * ((n * j) % POINTS) / POINTS);
                if (n <= CLOSING) {
                    const double width = pow(n, -4);
                    cosine[n - 1][j] = width * creal(wave[n][j]);
                    sine[n - 1][j] = width * cimag(wave[n][j]);
                }
            }
    double angle[POINTS], push[POINTS], x[UNKNOWNS] = {0};
    for (int j = 0; j < POINTS; j++) {
        Mode phi = 0, bend = 0;
        for (int n = 1; n <= M; n++) {
            phi += u[n] * wave[n][j];
            bend -= (c->k * n) * (c->k * n) * u[n] * wave[n][j];
        }
        angle[j] = 2 * M_PI * j / POINTS + c->k * 2 * creal(phi);
        push[j] = 4 * creal(bend) * creal(bend);
    }
    x[0] = -2 * c->k * creal(u[1]);
    x[1] = 2 * c->k * cimag(u[1]);
    Mode v = 0;
    for (int turn = 0; turn < 12; turn++) {
        double a[UNKNOWNS][UNKNOWNS] = {{0}}, b[UNKNOWNS] = {0};
        v = 0;
        for (int j = 0; j < POINTS; j++) {
            double basis[2 * CLOSING], theta = angle[j];
            for (int n = 0; n < CLOSING; n++) {
                basis[2 * n] = cosine[n][j];
                basis[2 * n + 1] = sine[n][j];
                theta += x[2 * n] * cosine[n][j] + x[2 * n + 1] * sine[n][j];
            }
            const double cs = cos(theta) / POINTS, sn = sin(theta) / POINTS;
            const double lx = x[UNKNOWNS - 2], ly = x[UNKNOWNS - 1];
            v += push[j] * (cs + I * sn);
            for (int p = 0; p < 2 * CLOSING; p++) {
                b[p] += basis[p] * (ly * cs - lx * sn);
                for (int q = 0; q <= p; q++) a[p][q] -= basis[p] * basis[q] * (lx * cs + ly * sn);
                a[UNKNOWNS - 2][p] -= sn * basis[p];
                a[UNKNOWNS - 1][p] += cs * basis[p];
            }
            b[UNKNOWNS - 2] += cs;
            b[UNKNOWNS - 1] += sn;
        }
        for (int p = 0; p < 2 * CLOSING; p++) {
            a[p][p] += 1;
            b[p] += x[p];
        }
        for (int p = 0; p < UNKNOWNS; p++)
            for (int q = 0; q < p; q++) a[q][p] = a[p][q];
        if (hypot(b[UNKNOWNS - 2], b[UNKNOWNS - 1]) < 1e-13) break;
        eliminate(a, b);
        for (int p = 0; p < UNKNOWNS; p++) x[p] -= b[p];
    }
    const double alpha3 = -4e-4 * c->length;
    return pow(2 * M_PI, 2) / pow(c->length, 2) * alpha3 * v; /* the mean over the points times L */
}

#endif
