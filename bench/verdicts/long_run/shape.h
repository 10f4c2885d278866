/* What is read off a shape without asking in which direction the body points. z_n turn by exp(-i n angle). */
#ifndef SHAPE_H
#define SHAPE_H
#include <complex.h>
#include <math.h>

typedef double complex Mode;

static void modes(const double *c, Mode *z)
{
    z[0] = c[0] - I * c[1];
    z[1] = 0.5 * (c[2] - I * c[3]);
    z[2] = 0.5 * (c[4] + I * c[5]);
}

static double size(const Mode *z)
{
    return sqrt(creal(z[0] * conj(z[0]) + z[1] * conj(z[1]) + z[2] * conj(z[2])));
}

static double dot(const Mode *a, const Mode *b)
{
    return creal(conj(a[0]) * b[0] + conj(a[1]) * b[1] + conj(a[2]) * b[2]);
}

/* How fast the shape changes when its turning is taken away: min over omega of |z' - omega G z|, (G z)_n = -i n z_n. */
static double reduced_rate(const Mode *z, const Mode *dz)
{
    const Mode g[3] = {-I * z[0], -2 * I * z[1], -3 * I * z[2]};
    const double gg = dot(g, g);
    const double omega = gg > 0 ? dot(g, dz) / gg : 0;
    const Mode rest[3] = {dz[0] - omega * g[0], dz[1] - omega * g[1], dz[2] - omega * g[2]};
    return size(rest);
}

static double turned_distance(const Mode *a, const Mode *b, double angle)
{
    double sum = 0;
    for (int n = 1; n <= 3; n++) {
        const Mode d = a[n - 1] - cexp(-I * n * angle) * b[n - 1];
        sum += creal(d * conj(d));
    }
    return sqrt(sum);
}

/* min over angle of |a - R(angle) b|, where b is mirrored first if asked for; the angle in *best. */
static double distance(const Mode *a, const Mode *b0, int mirrored, double *best)
{
    enum { GRID = 96 };
    const double spacing = 2 * M_PI / GRID;
    Mode b[3] = {b0[0], b0[1], b0[2]};
    if (mirrored)
        for (int n = 0; n < 3; n++) b[n] = conj(b[n]);
    double least = INFINITY, found = 0, near[GRID];
    for (int i = 0; i < GRID; i++) near[i] = turned_distance(a, b, i * spacing);
    for (int i = 0; i < GRID; i++) { /* every valley of the grid, by golden section */
        if (near[i] > near[(i + 1) % GRID] || near[i] > near[(i + GRID - 1) % GRID]) continue;
        const double ratio = 0.6180339887498949;
        double low = (i - 1) * spacing, high = (i + 1) * spacing;
        for (int step = 0; step < 60; step++) {
            const double x = high - ratio * (high - low), y = low + ratio * (high - low);
            if (turned_distance(a, b, x) < turned_distance(a, b, y)) high = y; else low = x;
        }
        const double d = turned_distance(a, b, 0.5 * (low + high));
        if (d < least) { least = d; found = 0.5 * (low + high); }
    }
    *best = remainder(found, 2 * M_PI);
    return least;
}

/* How far a shape is from one with a mirror axis, against its size: sines of the angles between modes. */
static double handedness(const Mode *z)
{
    const double s = size(z) + 1e-300;
    const Mode a = z[0] / s, b = z[1] / s, c = z[2] / s;
    double most = fabs(cimag(a * a * conj(b)));
    most = fmax(most, fabs(cimag(a * a * a * conj(c))));
    most = fmax(most, fabs(cimag(a * b * conj(c))));
    return fmax(most, fabs(cimag(b * b * b * conj(c) * conj(c))));
}

#endif
