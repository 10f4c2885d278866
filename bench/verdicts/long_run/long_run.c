/* Long runs of the tensor model, described by plain observables: what verdicts are checked against.

   Each line of standard input is one run:
     id  total  period  kick  seed  rtol  the 21 parameters  the start v1 v2 S11 S12 U111 U222
   A kick above 0 moves every coordinate of the start by up to that part of the largest (of 1e-3 at the origin).
   A period above 0 asks what the shape is after it, from where the run ended.
   Each line of standard output is one JSON object. */
#include "rkf78.h"
#include "shape.h"
#include "tensor.h"
#include "window.h"
#include <stdint.h>
#include <stdlib.h>

enum { PLANE = SHAPE + 2, ALL = PLANE + SHAPE, WINDOWS = 16, BURSTS = 4096, KEPT = 4096 };

static const double ESCAPED = 1e6; /* |z| beyond it */
static const double APART = 1e-8;  /* distance of the twin, against the size */
static const long MOST_STEPS = 600000;

typedef struct {
    const Parameters *p;
    int n;
} Context;

/* The shape, the place, and (n > PLANE) the twin's shape. */
static void field(const void *context, const double *u, double *du)
{
    const Context *c = context;
    rate(c->p, u, du);
    du[SHAPE] = u[0];
    du[SHAPE + 1] = u[1];
    if (c->n > PLANE) rate(c->p, u + PLANE, du + PLANE);
}

typedef struct {
    Context context;
    double t, h, rtol;
    double u[MOST], du[MOST];
} Run;

/* The worst error of a mode against its own size: what a mode is small against is left to the mode. */
static double misfit(const Run *r, const double *next, const double *error)
{
    double worst = 0;
    for (int n = 0; n < 3; n++) {
        const double e = hypot(error[2 * n], error[2 * n + 1]);
        const double a = fmax(hypot(r->u[2 * n], r->u[2 * n + 1]), hypot(next[2 * n], next[2 * n + 1]));
        worst = fmax(worst, e / (r->rtol * a + 1e-250));
    }
    return worst;
}

/* One accepted step, not beyond `end`. Returns 0 where steps vanish. */
static int advance(Run *r, double end)
{
    double next[MOST], error[MOST];
    for (;;) {
        const double h = fmin(r->h, end - r->t);
        rkf78(field, &r->context, r->context.n, r->u, h, next, error);
        const double e = misfit(r, next, error);
        const double factor = isfinite(e) ? 0.9 * pow(fmax(e, 1e-8), -1. / 8) : 0.1;
        if (isfinite(e) && e <= 1) {
            memcpy(r->u, next, sizeof next);
            r->t = h < end - r->t ? r->t + h : end;
            if (h == r->h || factor < 1) r->h = h * fmin(4, fmax(0.2, factor));
            field(&r->context, r->u, r->du);
            return 1;
        }
        r->h = h * fmin(0.7, fmax(0.1, factor));
        if (r->h < 1e-14 * fmax(1, r->t)) return 0;
    }
}

static Run start(const Parameters *p, const double *u, int n, double rtol)
{
    Run r = {.context = {p, n}, .t = 0, .h = 1e-3, .rtol = rtol};
    memcpy(r.u, u, n * sizeof *u);
    field(&r.context, r.u, r.du);
    return r;
}

/* |z| at the minimum between a step's start and its end (Illinois), by the step's own method. */
static double least_size(const Run *before, double h, double ga, double gb)
{
    const Context alone = {before->context.p, PLANE};
    double a = 0, b = h, state[MOST] = {0}, error[MOST], slope[MOST];
    Mode z[3], dz[3];
    for (int i = 0, side = 0; i < 30; i++) {
        const double x = a - ga * (b - a) / (gb - ga);
        rkf78(field, &alone, PLANE, before->u, x, state, error);
        field(&alone, state, slope);
        modes(state, z);
        modes(slope, dz);
        const double g = dot(z, dz);
        if (b - a < 1e-12 * h || fabs(g) < 1e-14 * size(z) * size(dz)) break;
        if (g < 0) { a = x; ga = g; if (side == -1) gb *= 0.5; side = -1; }
        else { b = x; gb = g; if (side == 1) ga *= 0.5; side = 1; }
    }
    return size(z);
}

/* Moves the twin back to its distance; returns the logarithm of how far it had come. */
static double pull_back(Run *r)
{
    double d2 = 0, s2 = 0;
    for (int i = 0; i < SHAPE; i++) {
        d2 += pow(r->u[PLANE + i] - r->u[i], 2);
        s2 += pow(r->u[i], 2);
    }
    const double wanted = APART * fmax(sqrt(s2), 1e-12), factor = wanted / sqrt(d2);
    for (int i = 0; i < SHAPE; i++) r->u[PLANE + i] = r->u[i] + factor * (r->u[PLANE + i] - r->u[i]);
    return sqrt(d2);
}

static double twin_distance(const Run *r)
{
    double d2 = 0;
    for (int i = 0; i < SHAPE; i++) d2 += pow(r->u[PLANE + i] - r->u[i], 2);
    return sqrt(d2);
}

typedef struct {
    Window windows[WINDOWS];
    int seen; /* complete windows */
    Burst bursts[BURSTS];
    int count;
    double minima[KEPT]; /* the first ones of the second half */
    int kept;
    double fastest, escape, time;
    long steps;
    const char *outcome;
} Record;

static void follow(Run *r, double total, Record *record)
{
    Mode z[3], dz[3];
    double heading = 0, last_angle = NAN, distance0 = twin_distance(r);
    int awake = 0;
    record->outcome = "completed";
    for (int w = 0; w < WINDOWS; w++) {
        Window *window = &record->windows[w];
        *window = (Window){.rate = none(), .speed = none(), .turn = none(), .size = none(), .hand = none(), .minima = none()};
        const double end = total * (w + 1) / WINDOWS, heading0 = heading;
        while (r->t < end) {
            const Run before = *r;
            modes(r->u, z);
            modes(r->du, dz);
            const double g0 = dot(z, dz);
            if (!advance(r, end) || ++record->steps > MOST_STEPS) {
                record->outcome = record->steps > MOST_STEPS ? "steps" : "underflow";
                record->escape = r->t;
                return;
            }
            modes(r->u, z);
            modes(r->du, dz);
            const double s = size(z), speed = cabs(z[0]), fast = reduced_rate(z, dz);
            if (!(s < ESCAPED)) {
                record->outcome = "escaped";
                record->escape = r->t;
                return;
            }
            see(&window->rate, fast);
            see(&window->speed, speed);
            see(&window->size, s);
            see(&window->hand, handedness(z));
            record->fastest = fmax(record->fastest, fast);
            if (speed > 1e-200) {
                see(&window->turn, -cimag(dz[0] / z[0])); /* z1 = conj(v) */
                const double angle = -carg(z[0]);
                if (!isnan(last_angle)) heading += remainder(angle - last_angle, 2 * M_PI);
                last_angle = angle;
            }
            if (fast > 0.01 * record->fastest && !awake) {
                if (record->count < BURSTS) record->bursts[record->count++] = (Burst){r->t, heading};
                awake = 1;
            } else if (fast < 0.005 * record->fastest) awake = 0;
            if (g0 < 0 && dot(z, dz) >= 0 && w >= WINDOWS / 2) {
                const double least = least_size(&before, r->t - before.t, g0, dot(z, dz));
                window->returns++;
                see(&window->minima, least);
                if (record->kept < KEPT) record->minima[record->kept++] = least;
            }
            if (r->context.n > PLANE) {
                const double d = twin_distance(r);
                if (d > 1e3 * distance0 || d < 1e-2 * distance0 || r->t == end) {
                    window->growth += log(pull_back(r) / distance0);
                    distance0 = twin_distance(r);
                }
            }
        }
        window->heading = heading - heading0;
        record->seen = w + 1;
    }
}

/* What the shape is after `period`, and the heading on the way. */
static void after(const Run *from, double period)
{
    enum { SAMPLES = 720 };
    Mode first[3], z[3], dz[3], half[3], third[3], quarter[3];
    Run r = *from;
    r.context.n = PLANE;
    r.t = 0;
    r.u[SHAPE] = r.u[SHAPE + 1] = 0;
    modes(r.u, first);
    double diameter = 0, angle = 0, swing_low = 0, swing_high = 0, heading = 0, last = NAN, across = 0, fastest = 0;
    Range speed = none(), hand = none(), rates = none();
    for (int i = 1; i <= SAMPLES; i++) {
        while (r.t < period * i / SAMPLES)
            if (!advance(&r, period * i / SAMPLES)) { printf(",\"after\":null"); return; }
        modes(r.u, z);
        modes(r.du, dz);
        if (i % 8 == 0) diameter = fmax(diameter, distance(z, first, 0, &angle));
        see(&speed, cabs(z[0]));
        see(&hand, handedness(z));
        see(&rates, reduced_rate(z, dz));
        fastest = fmax(fastest, cabs(z[0]));
        across = fmax(across, fabs(cimag(z[0] * conj(first[0]))) / (cabs(first[0]) + 1e-300));
        const double now = -carg(z[0]);
        if (!isnan(last)) heading += remainder(now - last, 2 * M_PI);
        last = now;
        swing_low = fmin(swing_low, heading);
        swing_high = fmax(swing_high, heading);
        if (i == SAMPLES / 2) memcpy(half, z, sizeof z);
        if (i == SAMPLES / 3) memcpy(third, z, sizeof z);
        if (i == SAMPLES / 4) memcpy(quarter, z, sizeof z);
    }
    double turn, turn_half, turn_mirror;
    const double whole = distance(z, first, 0, &turn);
    printf(",\"after\":{\"diameter\":%.6g,\"whole\":%.6g,\"turn\":%.10g", diameter, whole, turn);
    printf(",\"half\":%.6g", distance(half, first, 0, &turn_half));
    printf(",\"half_turn\":%.10g,\"half_mirrored\":%.6g", turn_half, distance(half, first, 1, &turn_mirror));
    printf(",\"third\":%.6g,\"quarter\":%.6g,\"quarter_mirrored\":%.6g", distance(third, first, 0, &angle),
           distance(quarter, first, 0, &angle), distance(quarter, first, 1, &angle));
    printf(",\"across\":%.6g,\"heading\":%.10g,\"swing\":%.10g,\"displacement\":%.10g", across / (fastest + 1e-300), heading,
           swing_high - swing_low, hypot(r.u[SHAPE], r.u[SHAPE + 1]));
    print_range("speed", speed);
    print_range("hand", hand);
    print_range("rate", rates);
    printf("}");
}

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* How many values the minima take: those closer than 1e-6 of their range are one. */
static int clusters(Record *record)
{
    double *m = record->minima;
    const int n = record->kept;
    if (n == 0) return 0;
    qsort(m, n, sizeof *m, by_size);
    int count = 1;
    for (int i = 1; i < n; i++) count += m[i] - m[i - 1] > 1e-6 * (m[n - 1] - m[0]);
    return count;
}

static double uniform(uint64_t *state) /* -1 .. 1; splitmix64 */
{
    uint64_t z = (*state += 0x9E3779B97F4A7C15u);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return (double)((z ^ (z >> 31)) >> 11) / (double)(1ull << 52) - 1;
}

int main(void)
{
    static Record record;
    char id[128];
    double total, period, kick, rtol;
    unsigned long long seed;
    while (scanf("%127s %lf %lf %lf %llu %lf", id, &total, &period, &kick, &seed, &rtol) == 6) {
        double values[PARAMETERS], u[MOST] = {0};
        Parameters p;
        for (int i = 0; i < PARAMETERS; i++)
            if (scanf("%lf", &values[i]) != 1) return 2;
        memcpy(&p, values, sizeof p);
        double largest = 0;
        for (int i = 0; i < SHAPE; i++) {
            if (scanf("%lf", &u[i]) != 1) return 2;
            largest = fmax(largest, fabs(u[i]));
        }
        uint64_t state = seed;
        for (int i = 0; i < SHAPE; i++) u[i] += kick * (largest > 0 ? largest : 1e-3) * uniform(&state);
        for (int i = 0; i < SHAPE; i++) u[PLANE + i] = u[i] + APART * fmax(largest, 1e-12) * uniform(&state);
        Run r = start(&p, u, ALL, rtol);
        memset(&record, 0, sizeof record);
        follow(&r, total, &record);
        printf("{\"id\":\"%s\",\"outcome\":\"%s\",\"t\":%.10g,\"steps\":%ld,\"fastest\":%.6g,\"windows\":[", id, record.outcome, r.t,
               record.steps, record.fastest);
        for (int w = 0; w < record.seen; w++) {
            if (w) printf(",");
            print_window(&record.windows[w]);
        }
        printf("],\"minima\":%d,\"clusters\":%d", record.kept, clusters(&record));
        printf(",\"bursts\":[");
        const int from = record.count > 24 ? record.count - 24 : 0;
        for (int i = from; i < record.count; i++)
            printf("%s[%.8g,%.8g]", i > from ? "," : "", record.bursts[i].t, record.bursts[i].heading);
        printf("]");
        printf(",\"last\":[%.17g,%.17g,%.17g,%.17g,%.17g,%.17g]", r.u[0], r.u[1], r.u[2], r.u[3], r.u[4], r.u[5]);
        if (period > 0 && record.seen == WINDOWS) after(&r, period);
        printf("}\n");
        fflush(stdout);
    }
    return 0;
}
