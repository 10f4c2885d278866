/* Throughput of fused multiply-adds on one core: independent chains in registers, as many as hide the latency; the best
   number of chains counts. WIDTH is the vector's number of doubles. Printed: floating-point operations (2 per lane and
   instruction) and seconds of the best one. */
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#ifndef WIDTH
#define WIDTH 4
#endif

typedef double V __attribute__((vector_size(WIDTH * 8)));

#if defined(__x86_64__)
#define KEEP(a) __asm__ volatile("" ::"x"(a)) /* one iteration stays one iteration */
#else
#define KEEP(a)
#endif

static double total, best_rate, best_seconds;
static int best_chains;

#define MEASURE(CHAINS)                                                                      \
  static void measure##CHAINS(long n, double factor, double term) {                          \
    V a[CHAINS], x, y;                                                                       \
    for (int l = 0; l < WIDTH; l++) x[l] = factor, y[l] = term;                              \
    for (int i = 0; i < CHAINS; i++)                                                         \
      for (int l = 0; l < WIDTH; l++) a[i][l] = i + l;                                       \
    struct timespec s, e;                                                                    \
    clock_gettime(CLOCK_MONOTONIC, &s);                                                      \
    for (long t = 0; t < n; t++) {                                                           \
      _Pragma("GCC unroll 24") for (int i = 0; i < CHAINS; i++) a[i] = a[i] * x + y;         \
      KEEP(a[0]);                                                                            \
    }                                                                                        \
    clock_gettime(CLOCK_MONOTONIC, &e);                                                      \
    double seconds = (e.tv_sec - s.tv_sec) + 1e-9 * (e.tv_nsec - s.tv_nsec);                 \
    double rate = 2.0 * WIDTH * CHAINS * n / seconds;                                        \
    for (int i = 0; i < CHAINS; i++)                                                         \
      for (int l = 0; l < WIDTH; l++) total += a[i][l];                                      \
    if (rate > best_rate) best_rate = rate, best_seconds = seconds, best_chains = CHAINS;    \
  }

MEASURE(12)
MEASURE(16)
MEASURE(20)
MEASURE(24)

int main(int argc, char **argv) {
  if (argc != 4) return 2;
  long n = atol(argv[1]);
  double factor = atof(argv[2]), term = atof(argv[3]);
  measure12(n, factor, term);
  measure16(n, factor, term);
  measure20(n, factor, term);
  measure24(n, factor, term);
  printf("{\"seconds\": %.9g, \"work\": %.9g, \"width\": %d, \"chains\": %d, \"check\": %.17g}\n", best_seconds,
         best_rate * best_seconds, WIDTH, best_chains, total);
}
