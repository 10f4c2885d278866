/* Fehlberg's method of orders 7 and 8 (NASA TR R-287, 1968), the eighth order carried on. */
#ifndef RKF78_H
#define RKF78_H
#include <math.h>
#include <string.h>

enum { STAGES = 13, MOST = 16 };

static const double RKF_A[STAGES][STAGES] = {
    {0},
    {2. / 27},
    {1. / 36, 1. / 12},
    {1. / 24, 0, 1. / 8},
    {5. / 12, 0, -25. / 16, 25. / 16},
    {1. / 20, 0, 0, 1. / 4, 1. / 5},
    {-25. / 108, 0, 0, 125. / 108, -65. / 27, 125. / 54},
    {31. / 300, 0, 0, 0, 61. / 225, -2. / 9, 13. / 900},
    {2, 0, 0, -53. / 6, 704. / 45, -107. / 9, 67. / 90, 3},
    {-91. / 108, 0, 0, 23. / 108, -976. / 135, 311. / 54, -19. / 60, 17. / 6, -1. / 12},
    {2383. / 4100, 0, 0, -341. / 164, 4496. / 1025, -301. / 82, 2133. / 4100, 45. / 82, 45. / 164, 18. / 41},
    {3. / 205, 0, 0, 0, 0, -6. / 41, -3. / 205, -3. / 41, 3. / 41, 6. / 41},
    {-1777. / 4100, 0, 0, -341. / 164, 4496. / 1025, -289. / 82, 2193. / 4100, 51. / 82, 33. / 164, 12. / 41, 0, 1},
};

static const double RKF_B[STAGES] = {0, 0, 0, 0, 0, 34. / 105, 9. / 35, 9. / 35, 9. / 280, 9. / 280, 0, 41. / 840, 41. / 840};

typedef void (*Field)(const void *context, const double *u, double *du);

/* One step of length h from u (n numbers) to out; error gets the estimate of each number. */
static void rkf78(Field f, const void *context, int n, const double *u, double h, double *out, double *error)
{
    double k[STAGES][MOST], w[MOST] = {0};
    for (int s = 0; s < STAGES; s++) {
        memcpy(w, u, n * sizeof *w);
        for (int r = 0; r < s; r++) {
            const double a = h * RKF_A[s][r];
            if (a != 0)
                for (int i = 0; i < n; i++) w[i] += a * k[r][i];
        }
        f(context, w, k[s]);
    }
    for (int i = 0; i < n; i++) {
        double sum = 0;
        for (int s = 5; s < STAGES; s++) sum += RKF_B[s] * k[s][i];
        out[i] = u[i] + h * sum;
        error[i] = fabs(41. / 840 * h * (k[0][i] + k[10][i] - k[11][i] - k[12][i]));
    }
}

#endif
