/* Long runs of the active cell, described as long_run.c describes those of the tensor model.

   Each line of standard input: id total period kick seed length, then c1 s1 .. c21 s21. Each line of standard output is one JSON object. */
#include "cell.h"
#include "window.h"
#include <stdint.h>
#include <stdlib.h>

enum { WINDOWS = 16, BURSTS = 4096, KEPT = 4096 };

static const double STEP = 0.0125, LOOK = 1.0, APART = 1e-8;

static double dot(const Shape a, const Shape b)
{
    double sum = 0;
    for (int n = 1; n <= M; n++) sum += creal(conj(a[n]) * b[n]);
    return sum;
}

static double size(const Shape u) { return sqrt(dot(u, u)); }

static double apart(const Shape a, const Shape b)
{
    Shape d;
    for (int n = 1; n <= M; n++) d[n] = a[n] - b[n];
    return size(d);
}

/* min over omega of |u' - omega G u|, (G u)_n = -i n u_n; short waves, which follow the others at large rates, are weighted down by
   their rates: what steps of finite length leave of them is no motion. */
static double reduced_rate(const Cell *c, const Shape u)
{
    Shape du, g;
    cell_rate(c, u, du);
    for (int n = 1; n <= M; n++) {
        const double weight = 1 / (1 + fabs(growth_rate(c->k * n)));
        g[n] = -I * n * weight * u[n];
        du[n] *= weight;
    }
    const double gg = dot(g, g), omega = gg > 0 ? dot(g, du) / gg : 0;
    for (int n = 1; n <= M; n++) du[n] -= omega * g[n];
    return size(du);
}

static double turned(const Shape a, const Shape b, double angle)
{
    double sum = 0;
    for (int n = 1; n <= M; n++) {
        const Mode d = a[n] - cexp(-I * n * angle) * b[n];
        sum += creal(d * conj(d));
    }
    return sqrt(sum);
}

/* min over angle of |a - R(angle) b|, b mirrored first (phi_n -> -conj phi_n) if asked for. */
static double distance(const Shape a, const Shape b0, int mirrored, double *best)
{
    enum { GRID = 128 };
    const double spacing = 2 * M_PI / GRID, ratio = 0.6180339887498949;
    Shape b;
    for (int n = 1; n <= M; n++) b[n] = mirrored ? -conj(b0[n]) : b0[n];
    double near[GRID], least = INFINITY, found = 0;
    for (int i = 0; i < GRID; i++) near[i] = turned(a, b, i * spacing);
    for (int i = 0; i < GRID; i++) {
        if (near[i] > near[(i + 1) % GRID] || near[i] > near[(i + GRID - 1) % GRID]) continue;
        double low = (i - 1) * spacing, high = (i + 1) * spacing;
        for (int step = 0; step < 50; step++) {
            const double x = high - ratio * (high - low), y = low + ratio * (high - low);
            if (turned(a, b, x) < turned(a, b, y)) high = y; else low = x;
        }
        const double d = turned(a, b, 0.5 * (low + high));
        if (d < least) { least = d; found = 0.5 * (low + high); }
    }
    *best = remainder(found, 2 * M_PI);
    return least;
}

/* What the shape is after `period`, and the heading on the way. */
static void after(Cell *c, const Shape from, double period)
{
    enum { SAMPLES = 720 };
    Shape first, u, half = {0}, third = {0}, quarter = {0};
    memcpy(first, from, sizeof first);
    memcpy(u, from, sizeof u);
    const long steps = ceil(period / SAMPLES / STEP);
    set_step(c, period / SAMPLES / steps);
    double diameter = 0, angle, turn, heading = 0, low = 0, high = 0, across = 0, fastest = 0;
    Range speed = none();
    Mode v0 = cell_velocity(c, u), last = v0, place = 0;
    for (int i = 1; i <= SAMPLES; i++) {
        for (long s = 0; s < steps; s++) cell_step(c, u);
        if (i % 8 == 0) diameter = fmax(diameter, distance(u, first, 0, &angle));
        const Mode v = cell_velocity(c, u);
        see(&speed, cabs(v));
        place += 0.5 * (v + last) * period / SAMPLES;
        fastest = fmax(fastest, cabs(v));
        across = fmax(across, fabs(cimag(v * conj(v0))) / (cabs(v0) + 1e-300));
        heading += carg(v * conj(last));
        low = fmin(low, heading);
        high = fmax(high, heading);
        last = v;
        if (i == SAMPLES / 2) memcpy(half, u, sizeof u);
        if (i == SAMPLES / 3) memcpy(third, u, sizeof u);
        if (i == SAMPLES / 4) memcpy(quarter, u, sizeof u);
    }
    const double whole = distance(u, first, 0, &turn);
    printf(",\"after\":{\"diameter\":%.6g,\"whole\":%.6g,\"turn\":%.10g", diameter, whole, turn);
    printf(",\"half\":%.6g,\"half_mirrored\":%.6g", distance(half, first, 0, &angle), distance(half, first, 1, &angle));
    printf(",\"third\":%.6g,\"quarter\":%.6g", distance(third, first, 0, &angle), distance(quarter, first, 0, &angle));
    printf(",\"across\":%.6g,\"heading\":%.10g,\"swing\":%.10g,\"displacement\":%.10g", across / (fastest + 1e-300), heading,
           high - low, cabs(place));
    print_range("speed", speed);
    printf("}");
}

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double uniform(uint64_t *state) /* -1 .. 1; splitmix64 */
{
    uint64_t z = (*state += 0x9E3779B97F4A7C15u);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return (double)((z ^ (z >> 31)) >> 11) / (double)(1ull << 52) - 1;
}

static void run(const char *id, Cell *c, Shape u, Shape twin, double total, double period)
{
    static Burst bursts[BURSTS];
    static double minima[KEPT];
    int burst_count = 0, kept = 0, awake = 0;
    double fastest = 0, before = 0, now = size(u), gap = apart(u, twin);
    Mode last = 0;
    const long per_look = lround(LOOK / STEP), looks = lround(total / LOOK / WINDOWS);
    printf("{\"id\":\"%s\",\"outcome\":\"completed\",\"windows\":[", id);
    for (int w = 0; w < WINDOWS; w++) {
        Window window = {.rate = none(), .speed = none(), .turn = none(), .size = none(), .hand = none(), .minima = none()};
        for (long look = 0; look < looks; look++) {
            for (long s = 0; s < per_look; s++) {
                cell_step(c, u);
                cell_step(c, twin);
                const double next = size(u);
                if (now < before && now <= next && w >= WINDOWS / 2) { /* a parabola through three sizes */
                    const double bend = before - 2 * now + next, slope = 0.5 * (next - before);
                    const double least = now - (bend > 0 ? 0.5 * slope * slope / bend : 0);
                    window.returns++;
                    see(&window.minima, least);
                    if (kept < KEPT) minima[kept++] = least;
                }
                before = now;
                now = next;
            }
            const double rate = reduced_rate(c, u), t = (w * looks + look + 1) * LOOK;
            see(&window.rate, rate);
            see(&window.size, now);
            fastest = fmax(fastest, rate);
            const int wakes = rate > 0.01 * fastest && !awake;
            const int late = w * looks + look + 1 >= WINDOWS / 2 * looks; /* the velocity is computed at every look of the second half */
            if (wakes || late) {
                const Mode v = cell_velocity(c, u);
                if (wakes && burst_count < BURSTS) bursts[burst_count++] = (Burst){t, carg(v)};
                see(&window.speed, cabs(v));
                if (w >= WINDOWS / 2 && cabs(v) > 0 && cabs(last) > 0) {
                    window.heading += carg(v * conj(last));
                    see(&window.turn, carg(v * conj(last)) / LOOK);
                }
                if (late) last = v;
            }
            awake = wakes || (awake && rate > 0.005 * fastest);
            const double d = apart(u, twin);
            if (d > 1e3 * gap || d < 1e-2 * gap || look == looks - 1) {
                window.growth += log(d / gap);
                const double factor = APART * fmax(now, 1e-12) / d;
                for (int n = 1; n <= M; n++) twin[n] = u[n] + factor * (twin[n] - u[n]);
                gap = apart(u, twin);
            }
        }
        if (w) printf(",");
        print_window(&window);
    }
    qsort(minima, kept, sizeof *minima, by_size);
    int clusters = kept > 0;
    for (int i = 1; i < kept; i++) clusters += minima[i] - minima[i - 1] > 1e-5 * (minima[kept - 1] - minima[0]);
    printf("],\"t\":%.10g,\"fastest\":%.6g,\"minima\":%d,\"clusters\":%d,\"bursts\":[", looks * LOOK * WINDOWS, fastest, kept, clusters);
    const int from = burst_count > 24 ? burst_count - 24 : 0;
    for (int i = from; i < burst_count; i++)
        printf("%s[%.8g,%.8g]", i > from ? "," : "", bursts[i].t, bursts[i].heading);
    printf("]");
    if (period > 0) after(c, u, period);
    printf("}\n");
    fflush(stdout);
}

int main(void)
{
    char id[128];
    double total, period, kick, length;
    unsigned long long seed;
    while (scanf("%127s %lf %lf %lf %llu %lf", id, &total, &period, &kick, &seed, &length) == 6) {
        Cell c = {.length = length, .k = 2 * M_PI / length};
        Shape u = {0}, twin = {0};
        double largest = 0;
        for (int n = 1; n <= M; n++) {
            double a, b;
            if (scanf("%lf %lf", &a, &b) != 2) return 2;
            u[n] = 0.5 * (a - I * b);
            largest = fmax(largest, cabs(u[n]));
        }
        uint64_t state = seed;
        const double scale = largest > 0 ? largest : 1e-3;
        for (int n = 1; n <= M; n++) {
            u[n] += kick * scale * (uniform(&state) + I * uniform(&state));
            twin[n] = u[n] + APART * scale * (uniform(&state) + I * uniform(&state));
        }
        set_step(&c, STEP);
        run(id, &c, u, twin, total, period);
    }
    return 0;
}
