"""The rivals' decision: what a motion is, from samples of its orbit. The same code whatever integrates the orbits.

The looks at an orbit double in length until one of these questions is answered, or the budget is spent:

1. blow-up: the integrator left every bound;
2. motionless, straight, circular: the shape rests in the co-rotating frame, Newton's method finds a relative equilibrium there
   that is stable by its eigenvalues, and the orbit is within 1e-3 of it and comes closer;
3. rectangular: the last three rests were beside motionless saddles that attract as a cycle (lambda_+ + lambda_- < 0);
4. pulsating straight, zigzag, quasi-periodic: the rotation invariants at the maxima of the size repeat to 1e-5 of the motion's
   diameter, at equal times, over the last returns; mirror image or net rotation decide the word;
5. chaotic: the largest exponent of the variational equation, over two runs or more, is above three times its 95 % error, and
   neighbouring orbits separated by more than e^10.
"""

from dataclasses import dataclass, field

import numpy as np

from equilibria import frame, newton, norm, odd_rates
from returns import invariants, maxima, rotation

RESTING = 0.05  # of the fastest change: worth Newton's method
STILL = 1e-8  # of the size per unit of time: the same, if it never moved faster
NEAR = 1e-3  # of the size: beside an equilibrium
REPEATS = 1e-5  # of the diameter
LONG = 8.0  # rests shorter than the longest one by more than this factor are no rests
STUDENT = 2.09  # 95 % of Student's t with 19 degrees of freedom
BLOCKS = 20


@dataclass
class Motion:
    """What is known of one motion."""

    fastest: float = 0.0
    largest: float = 0.0
    spent: float = 0.0
    rests: list = field(default_factory=list)  # [duration, shape, whole]
    logs: list = field(default_factory=list)  # of the tangent vector's growth: (logs, interval) of each run
    regime: str = "undetermined"
    evidence: str = "nothing was seen"


class Judge:
    def __init__(self, model, motions):
        self.model, self.motions = model, motions

    def look(self, cells, u, span):
        """Takes in samples u (cells, samples, 2m) of a look; returns the cells that are still open."""
        _, rates = frame(self.model, cells, u)
        for i, cell in enumerate(cells):
            motion = self.motions[cell]
            settled = 0 if motion.spent else len(rates[i]) // 10  # stiff modes of the start die out first
            motion.spent += span
            motion.fastest = max(motion.fastest, rates[i, settled:].max())
            motion.largest = max(motion.largest, norm(u[i]).max())
        limits = [max(RESTING * self.motions[cell].fastest, STILL * self.motions[cell].largest) for cell in cells]
        resting = np.flatnonzero(rates[:, -1] < limits)
        decided = self.equilibria(cells[resting], u[resting, -1], rates[resting])
        rest = [i for i, cell in enumerate(cells) if cell not in decided]
        return np.array([cells[i] for i in rest if not self.moving(cells[i], u[i], rates[i], span)], dtype=int)

    def equilibria(self, cells, last, rates):
        if not len(cells):
            return set()
        shape, omega, residual, values = newton(self.model, cells, last)
        speed = self.model.speed(cells, shape)
        decided = set()
        for i, cell in enumerate(cells):
            motion = self.motions[cell]
            distance = norm(last[i] - shape[i])
            size = max(norm(shape[i]), motion.largest)
            closer = distance < self.model.arrived * size or rates[i, -1] < 0.9 * rates[i, int(0.8 * rates.shape[1])]
            if residual[i] > 1e-10 or values[i, 0] > -1e-8 or distance > NEAR * size or not closer:
                motion.evidence = f"rests beside an equilibrium with growth rate {values[i, 0]:.2g}, at {distance / size:.1e}"
                continue
            if speed[i] < 1e-8:
                motion.regime = "motionless"
            else:
                motion.regime = "straight" if abs(omega[i]) < 1e-8 else "circular"
            motion.evidence = f"stable equilibrium, slowest rate {values[i, 0]:.3g}, at {distance / size:.1e} of its size"
            decided.add(cell)
        return decided

    def moving(self, cell, u, rates, span):
        """Questions 3 and 4 of one motion; whether it is decided."""
        self.add_rests(self.motions[cell], u, rates)
        return self.cycle(cell) or self.recurs(cell, u)

    def add_rests(self, motion, u, rates):
        slow = np.concatenate([[False], rates < 1e-2 * motion.fastest, [False]])
        edges = np.flatnonzero(slow[1:] != slow[:-1])
        for first, last in zip(edges[::2], edges[1::2]):
            shape = u[first + np.argmin(rates[first:last])]
            if first == 0 and motion.rests and not motion.rests[-1][2]:
                motion.rests[-1] = [motion.rests[-1][0] + last * self.model.sample, shape, last < len(rates)]
            else:
                motion.rests.append([(last - first) * self.model.sample, shape, last < len(rates)])

    def cycle(self, cell):
        motion = self.motions[cell]
        longest = max((rest[0] for rest in motion.rests), default=0.0)
        rests = [rest for rest in motion.rests if LONG * rest[0] >= longest][-3:]
        if len(rests) < 3:
            return False
        cells = np.full(3, cell)
        last = np.array([rest[1] for rest in rests])
        shape, omega, residual, values = newton(self.model, cells, last)
        still = (self.model.speed(cells, shape) < 1e-8) & (np.abs(omega) < 1e-8) & (residual < 1e-10)
        near = norm(last - shape) < 1e-2 * np.maximum(norm(shape), 1e-300)
        single = (values[:, 1] < 0) | (np.abs(values[:, 1] - values[:, 0]) < 1e-9) & (values[:, 2] < 0)  # one, or a pair
        if not np.all(still & near & (values[:, 0] > 0) & single):
            return False
        out, inward = odd_rates(self.model, cells[:1], shape[-1:])
        motion.evidence = f"rests at saddles, lambda_+ = {out:.4g}, lambda_- = {inward:.4g}"
        if out + inward < 0:
            motion.regime = "rectangular"
        return out + inward < 0

    def recurs(self, cell, u):
        half = u[len(u) // 2 :]
        seen = invariants(half)
        diameter = np.max(np.ptp(seen.real, axis=0) + np.ptp(seen.imag, axis=0))
        times, states = maxima(self.model, cell, u)
        points = invariants(states)
        mirrored = np.max(np.abs(seen.imag)) < 1e-6 * diameter and self.heads_one_way(half)
        for p in range(1, min(24, (len(points) - 1) // 3) + 1):
            last = max(2 * p, 6)
            if len(points) < last + p + 1:
                break
            now, before = points[-last:], points[-last - p : -p]
            lapse = times[-last:] - times[-last - p : -p]
            if np.ptp(lapse) > 1e-3 * lapse[0]:
                continue
            if np.max(np.abs(now - before)) < REPEATS * diameter:
                return self.periodic(cell, lapse[-1], states[-1 - p], states[-1], mirrored)
            if np.max(np.abs(now - before.conj())) < REPEATS * diameter:
                self.motions[cell].regime = "zigzag"
                self.motions[cell].evidence = f"mirror image after {lapse[-1]:.6g}"
                return True
        self.motions[cell].evidence = "the shape does not come back"
        return False

    @staticmethod
    def heads_one_way(u):
        """Whether the first amplitude stays on a line: a cycle of saddles is mirror symmetric too while it is not tiny."""
        z = u[:, 0] + 1j * u[:, 1]
        longest = z[np.argmax(np.abs(z))]
        return np.max(np.abs((z * np.conj(longest)).imag)) < 1e-6 * np.abs(longest) ** 2

    def periodic(self, cell, period, before, now, mirrored):
        angle = rotation(self.model, before, now)
        straight = abs(np.sin(angle)) < 1e-3  # a body that goes back and forth turns by half a turn
        motion = self.motions[cell]
        if mirrored and straight:
            motion.regime = "pulsating-straight"
        else:
            motion.regime = "zigzag" if abs(angle) < 1e-3 else "quasi-periodic"
        motion.evidence = f"period {period:.6g}, net rotation {angle:.4g}"
        return True

    def exponents(self, cells, logs, interval, span):
        """Takes in the logarithms of growth (cells, intervals) of a run; returns the cells that are still open."""
        still_open = []
        for cell, found in zip(cells, logs):
            motion = self.motions[cell]
            motion.spent += span
            motion.logs.append(found[len(found) // 5 :] / interval)
            if not self.chaotic(motion, interval):
                still_open.append(cell)
        return np.array(still_open, dtype=int)

    @staticmethod
    def chaotic(motion, interval):
        if len(motion.logs) < 2:
            return False
        rates = np.concatenate(motion.logs[-2:])
        blocks = np.array([block.mean() for block in np.array_split(rates, BLOCKS)])
        value, error = blocks.mean(), STUDENT * blocks.std(ddof=1) / np.sqrt(BLOCKS)
        motion.evidence = f"lambda_1 = {value:.3g} +- {error:.1g}"
        if value > 3 * error and value * len(rates) * interval > 10:
            motion.regime = "chaotic"
            return True
        return False
