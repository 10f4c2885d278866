"""Orbits under noise in lanes against the same orbits on their own: no other program, the results are the same bits."""

import environment
from harness import Contestant, compete, relative
from rivals import program

T = 100.0


def rows(scale, repeats):
    """Rates for rows between the steps of the noise and at their ends, on one thread and on all."""
    n = max(32, int(256 * scale) // 8 * 8)
    wanted = {}

    def entry(form, every, threads):
        keys = {"members": n, "t": T, "form": form, "every": every, "threads": threads}
        name = f"motiform {form}, a row every {every:g}, {threads} thread{'s' * (threads > 1)}"

        def error(check):
            """Against single orbits, to the bit."""
            alone = {**keys, "form": "alone", "threads": 1}
            if every not in wanted:
                wanted[every] = program.motiform("noisy", **alone)().check
            return relative(check, wanted[every])

        return Contestant(name, lambda: program.motiform("noisy", **keys), error, 0.0)

    kinds = [(every, threads) for every in (0.1, 1.0) for threads in (1, environment.THREADS)]
    environment.pin(environment.ALL_CORES)
    try:
        found = compete([entry(form, *kind) for kind in kinds for form in ("lanes", "alone")], "time units/s", repeats)
    finally:
        environment.pin()
    return found, [f"tensor model, additive noise of amplitude 1e-3, steps of the noise 1/16, rtol 1e-9; error: difference from single orbits; {n} members of {T:g} time units"]
