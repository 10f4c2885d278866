/* What is printed of a window of time; the runs of both models report the same. */
#ifndef WINDOW_H
#define WINDOW_H
#include <math.h>
#include <stdio.h>

/* Least and most of something. */
typedef struct {
    double low, high;
} Range;

typedef struct {
    double growth, heading;
    Range rate, speed, turn, size, hand, minima;
    int returns;
} Window;

typedef struct {
    double t, heading;
} Burst;

static Range none(void) { return (Range){INFINITY, -INFINITY}; }

static void see(Range *r, double x)
{
    r->low = fmin(r->low, x);
    r->high = fmax(r->high, x);
}

static double number(double x) { return isfinite(x) ? x : 0; }

static void print_range(const char *name, Range r)
{
    printf(",\"%s\":[%.10g,%.10g]", name, number(r.low), number(r.high));
}

static void print_window(const Window *w)
{
    printf("{\"growth\":%.10g,\"heading\":%.10g,\"returns\":%d", number(w->growth), number(w->heading), w->returns);
    print_range("rate", w->rate);
    print_range("speed", w->speed);
    print_range("turn", w->turn);
    print_range("size", w->size);
    print_range("hand", w->hand);
    print_range("minima", w->minima);
    printf("}");
}

#endif
