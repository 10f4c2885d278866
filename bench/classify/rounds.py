"""Rounds of looks, each twice as long as the last one, until every motion is decided or its budget is spent."""

import numpy as np

from judge import Judge, Motion


def classify(model, flow, start, many=256):
    """Decides all motions of the model from one start each (cells, 2m), at most `many` side by side."""
    motions = [Motion() for _ in start]
    judge = Judge(model, motions)
    for first in range(0, len(start), many):
        rounds(judge, flow, np.arange(first, min(first + many, len(start))), start.copy())
    return motions


def rounds(judge, flow, cells, state):
    span, first = judge.model.first_look, True
    while len(cells):
        samples, gone = flow.look(cells, state[cells], span)
        cells, samples = escaped(judge.motions, cells, samples, gone)
        if not len(cells):
            break
        state[cells] = samples[:, -1]
        cells = judge.look(cells, samples, span)
        if not first and len(cells):
            logs, interval, ends, gone = flow.exponent(cells, state[cells], span)
            state[cells] = ends
            cells, logs = escaped(judge.motions, cells, logs, gone)
            cells = judge.exponents(cells, logs, interval, span)
        cells = np.array([cell for cell in cells if judge.motions[cell].spent < judge.model.budget], dtype=int)
        span, first = 2 * span, False


def escaped(motions, cells, found, gone):
    for cell in cells[gone]:
        motions[cell].regime, motions[cell].evidence = "blow-up", "the orbit left every bound"
    return cells[~gone], found[~gone]
