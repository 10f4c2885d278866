"""The tensor model as a user's own equations: a list of products against the built-in kernel, and against heyoka."""

import reference
from harness import Contestant, compete, relative
from rivals import heyoka_amplitudes, program

T, ALLOWED = 20.0, 100


def rows(scale, repeats, rtol=1e-9):
    """Rates with the setup counted (reading the text, or compiling) and not counted."""
    n = max(8, int(16384 * scale) // 8 * 8)

    def entry(name, prepare):
        error = lambda check: relative(check, reference.end_states(n, T))  # noqa: E731
        return Contestant(name, prepare, error, ALLOWED * rtol)

    def mine(name, **keys):
        return entry(f"motiform {name}", lambda: program.motiform("amplitudes", members=n, t=T, rtol=rtol, threads=1, **keys))

    def theirs(name, terms, counted, fast):
        return entry(f"heyoka {name}", lambda: heyoka_amplitudes.adaptive(n, T, rtol, terms, counted, fast))

    list_ = []
    for terms, text in (("paper", "8 terms"), ("all", "22 terms")):
        list_ += [
            mine(f"built-in, {text}", terms=terms, form="built-in"),
            mine(f"text, {text}", terms=terms),
            mine(f"text, {text}, setup counted", terms=terms, setup="counted"),
            theirs(f"batch 8, {text}", terms, False, False),
            theirs(f"batch 8 fast, {text}", terms, False, True),
            theirs(f"batch 8 fast, {text}, compilation counted", terms, True, True),
        ]
    found = compete(list_, "time units/s", repeats)
    return found, [f"error at t = {T:g}, relative; allowed: {ALLOWED} times the tolerance; {n} members of {T:g} time units"]
