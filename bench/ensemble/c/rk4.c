/* Fixed-step RK4 of the tensor model, an ensemble as structure of arrays, LANES members at a time: plain loops for the
   compiler to vectorise. All numbers come from the command line, so nothing is folded; the end states of all members go
   into the printed sum, so nothing is dead.

   rk4 MEMBERS STEPS DT GAMMA KAPPA3 E11 E21 E22 E31 E32 KAPPA2_LOW KAPPA2_HIGH BASE(6)  ->  one JSON object */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#ifndef LANES
#define LANES 16
#endif

typedef struct { double gamma, kappa3, e11, e21, e22, e31, e32; } Coefficients;
typedef struct { double u[6][LANES], kappa2[LANES]; } Block;

static inline void field(const Coefficients *p, const double *k2, const double u[6][LANES], double f[6][LANES]) {
  for (int i = 0; i < LANES; i++) {
    double a = u[0][i], b = u[1][i], c = u[2][i], d = u[3][i], x = u[4][i], y = u[5][i];
    double aa = a * a, bb = b * b, q = p->gamma - (aa + bb);
    double re = aa - bb, im = 2 * (a * b);
    double wr = p->e31 * re + p->e32 * c, wi = p->e31 * im + p->e32 * d;
    f[0][i] = q * a + p->e11 * (a * c + b * d);
    f[1][i] = q * b + p->e11 * (a * d - b * c);
    f[2][i] = p->e21 * re + p->e22 * (a * x + b * y) - k2[i] * c;
    f[3][i] = p->e21 * im + p->e22 * (a * y - b * x) - k2[i] * d;
    f[4][i] = a * wr - b * wi - p->kappa3 * x;
    f[5][i] = a * wi + b * wr - p->kappa3 * y;
  }
}

#define EACH for (int j = 0; j < 6; j++) for (int i = 0; i < LANES; i++)

static inline void step(const Coefficients *p, const double *k2, double u[6][LANES], double h) {
  double k[6][LANES], v[6][LANES], sum[6][LANES];
  double h2 = h / 2, h3 = h / 3, h6 = h / 6;
  field(p, k2, u, k);
  EACH { sum[j][i] = u[j][i] + h6 * k[j][i]; v[j][i] = u[j][i] + h2 * k[j][i]; }
  field(p, k2, v, k);
  EACH { sum[j][i] += h3 * k[j][i]; v[j][i] = u[j][i] + h2 * k[j][i]; }
  field(p, k2, v, k);
  EACH { sum[j][i] += h3 * k[j][i]; v[j][i] = u[j][i] + h * k[j][i]; }
  field(p, k2, v, k);
  EACH u[j][i] = sum[j][i] + h6 * k[j][i];
}

int main(int argc, char **argv) {
  if (argc != 19) return 2;
  double value[19];
  for (int i = 1; i < argc; i++) value[i] = atof(argv[i]);
  long n = atol(argv[1]), steps = atol(argv[2]), blocks = (n + LANES - 1) / LANES;
  double dt = value[3];
  Coefficients p = {value[4], value[5], value[6], value[7], value[8], value[9], value[10]};
  Block *block = aligned_alloc(64, blocks * sizeof(Block));
  if (!block) return 1;
  for (long m = 0; m < blocks * LANES; m++) {
    Block *b = block + m / LANES;
    b->kappa2[m % LANES] = value[11] + (value[12] - value[11]) * m / (n > 1 ? n - 1 : 1);
    for (int j = 0; j < 6; j++) b->u[j][m % LANES] = value[13 + j] * (1 + 0.1 * sin(1.0 + 0.7 * m + 1.3 * j));
  }
  struct timespec s, e;
  clock_gettime(CLOCK_MONOTONIC, &s);
  for (long m = 0; m < blocks; m++)
    for (long t = 0; t < steps; t++) step(&p, block[m].kappa2, block[m].u, dt);
  clock_gettime(CLOCK_MONOTONIC, &e);
  double sum = 0;
  for (long m = 0; m < blocks * LANES; m++)
    for (int j = 0; j < 6; j++) sum += block[m / LANES].u[j][m % LANES];
  double seconds = (e.tv_sec - s.tv_sec) + 1e-9 * (e.tv_nsec - s.tv_nsec);
  printf("{\"seconds\": %.9g, \"work\": %ld, \"sum\": %.17g, \"check\": [", seconds, blocks * LANES * steps, sum);
  for (int m = 0; m < 8; m++)
    for (int j = 0; j < 6; j++)
      printf("%s%.17g%s", j ? ", " : m ? ", [" : "[", block[m / LANES].u[j][m % LANES], j == 5 ? "]" : "");
  printf("]}\n");
}
