"""What a long run says of a verdict: agrees, contradicted, transient (true, and ended later), or undecided."""

import math

CLOSES = 1e-3  # of the diameter: after its period a shape is back
SETTLED = 1e-6  # of the fastest change: at rest
TURNED = 1e-5  # rad per period: a net rotation

# What a periodic motion is called, by what it was seen to do; its forms.
PERIODIC_NAMES = {
    "at rest": ("motionless", {"pulsating-at-rest"}),
    "fixed heading": ("pulsating-straight", {"pulsating-straight", "back-and-forth"}),
    "mirrored": ("zigzag", {"mirror-zigzag"}),
    "no net rotation": ("zigzag", {"asymmetric-zigzag"}),
    "turns": ("quasi-periodic", {"rotating-zigzag", "pulsating-circular", "rosette"}),
}


def judge(verdict, run):
    """(status, reason)."""
    attractor = verdict["attractor"]
    if run["outcome"] == "steps":
        return "undecided", "the long run needs too many steps"
    if attractor == "escape":
        return blow_up(verdict, run)
    if run["outcome"] != "completed":
        if attractor == "chaotic" and run["t"] > verdict["time"]:
            return "transient", f"escapes at t = {run['t']:.6g}"
        return "contradicted", f"the long run escapes at t = {run['t']:.6g}"
    return {"equilibrium": equilibrium, "unstable": equilibrium, "periodic": periodic, "torus": torus, "heteroclinic": cycle,
            "chaotic": chaotic}[attractor](verdict, run)


def blow_up(verdict, run):
    """Out of chaos the last digits decide when an orbit escapes: another time is no contradiction then."""
    spread = sum(window["growth"] for window in run["windows"])
    if run["outcome"] == "completed":
        if spread > 30:
            return "undecided", f"chaotic, no escape in a time of {run['t']:.6g}"
        return "contradicted", "the long run stays bounded"
    claimed = verdict["escape_time"]
    if abs(claimed - run["t"]) > 1e-4 * run["t"] + 1e-6:
        return "undecided", f"escapes at {run['t']:.8g}, not {claimed:.8g}"
    return "agrees", ""


def late(run):
    return run["windows"][8:]


def high(run, name):
    return max(window[name][1] for window in late(run))


def low(run, name):
    return min(window[name][0] for window in late(run))


def halves(run, name):
    """By how much the largest value of a window falls from the middle of the run to its end."""
    first, last = late(run)[0][name][1], late(run)[-1][name][1]
    return last / first if first > 0 else 0.0


def at_rest(run):
    """The reduced shape has stopped changing; or its rate is a small constant, which steps of finite length leave on a turning shape."""
    rate = high(run, "rate")
    left_over = rate < 1e-4 * run["fastest"] and low(run, "rate") > 0.999 * rate
    return left_over or rate <= max(SETTLED * run["fastest"], 1e-9 * high(run, "size"))


def settling(run):
    """It changes less and less, and by little."""
    last = late(run)[-1]["rate"][1] / run["fastest"]
    return halves(run, "rate") < 0.5 and last < 1e-2 or halves(run, "rate") < 1 and last < 1e-4


def largest_ever(run):
    return max(window["size"][1] for window in run["windows"])


def moves(run):
    return high(run, "speed") > 1e-6 * largest_ever(run) and halves(run, "speed") > 0.5


def turning_rate(run):
    windows = late(run)
    return sum(window["heading"] for window in windows) / (0.5 * run["t"])


def equilibrium(verdict, run):
    if not at_rest(run):
        if settling(run) or run["t"] < verdict["time"]:
            return "undecided", "still on its way to an equilibrium"
        return "contradicted", f"the shape goes on changing (rate {high(run, 'rate'):.2g} of {run['fastest']:.2g})"
    regime, moving, rate = verdict["regime"], moves(run), turning_rate(run)
    turning = moving and abs(rate) * run["t"] > 1e-2
    seen = "circular" if turning else "straight" if moving else "motionless"
    if regime == "spinning" and not moving:
        return "undecided", "turns on the spot"
    if seen != regime:
        return "contradicted", f"{seen} (speed {high(run, 'speed'):.3g}, turning rate {rate:.3g})"
    if turning and abs(abs(rate) - abs(verdict["turning_rate"])) > 1e-4 * abs(rate):
        return "contradicted", f"turning rate {rate:.6g}, not {verdict['turning_rate']:.6g}"
    if moving and abs(high(run, "speed") - verdict["speed"]["mean"]) > 1e-4 * high(run, "speed"):
        return "contradicted", f"speed {high(run, 'speed'):.6g}, not {verdict['speed']['mean']:.6g}"
    return "agrees", ""


def seen_after(period):
    """Which symmetric periodic motion it is."""
    if period["speed"][1] < 1e-9 * period["diameter"]:
        return "at rest"
    if period["across"] < 1e-6:
        return "fixed heading"
    if abs(period["turn"]) > TURNED:
        return "turns"
    return "mirrored" if period["half_mirrored"] < CLOSES * period["diameter"] else "no net rotation"


def periodic(verdict, run):
    period = run.get("after")
    if at_rest(run):
        return "contradicted", "the shape rests"
    if not period:
        return "undecided", "no period"
    diameter = period["diameter"]
    if period["whole"] > CLOSES * diameter:
        return "contradicted", f"after the period the shape is off by {period['whole'] / diameter:.2g} of the diameter"
    for name in ("half", "third", "quarter"):
        if name == "half" and abs(math.remainder(2 * period.get("half_turn", period["turn"] / 2) - period["turn"], math.tau)) > 1e-3:
            continue  # a shape that is nearly its own mirror image, turned to the other side in the second half
        if name == "half" and abs(period["turn"]) < TURNED and abs(math.remainder(period.get("half_turn", 0.0), math.tau)) > 1e-3:
            continue  # turned by half a turn: forth and back is one period
        if period[name] < CLOSES * diameter:
            if period["whole"] > 1e-5 * diameter:
                return "undecided", f"near a saddle: after a {name} of the period it is as close as after all of it"
            if period[name] < 1e-5 * diameter:
                return "contradicted", f"it repeats after a {name} of the period"
    seen = seen_after(period)
    regime, forms = PERIODIC_NAMES[seen]
    if verdict["regime"] != regime or verdict["form"] not in forms:
        if seen == "turns" and abs(period["turn"]) <= period["whole"] / diameter:
            # near a saddle the periods of the two programs differ
            return "undecided", f"turns by {period['turn']:.2g} rad, and misses its return by {period['whole'] / diameter:.2g} of its diameter"
        if shrinks(run):
            return "undecided", f"still on its way: {seen} by {period['turn']:.2g} rad and ever less"
        return "contradicted", f"{seen}, not {verdict['form']} (heading across by {period['across']:.2g}, turn {period['turn']:.6g})"
    return "agrees", ""


def growth(windows, length):
    """Mean growth rate of the twin's distance and its 95 % half width."""
    rates = [window["growth"] / length for window in windows]
    mean = sum(rates) / len(rates)
    deviation = math.sqrt(sum((x - mean) ** 2 for x in rates) / (len(rates) - 1))
    return mean, 2.2 * deviation / math.sqrt(len(rates))


def shrinks(run):
    """The range of the minima falls from window to window: the orbit approaches something."""
    spreads = [window["minima"][1] - window["minima"][0] for window in late(run)]
    return all(b < a for a, b in zip(spreads, spreads[1:]))


def torus(verdict, run):
    if at_rest(run):
        return "contradicted", "the shape rests"
    length = run["t"] / 16
    rate, error = growth(late(run), length)
    if rate > 2 * error and rate * 8 * length > 15:
        return "contradicted", f"neighbouring orbits separate at {rate:.3g} +- {error:.2g}"
    spreads = [window["minima"][1] - window["minima"][0] for window in late(run)]
    if shrinks(run) and spreads[-1] < 0.8 * spreads[0]:
        return "contradicted", f"the curve shrinks from {spreads[0]:.3g} to {spreads[-1]:.3g}"
    if run["minima"] > 300 and run["clusters"] < 60:
        return "contradicted", f"periodic: {run['clusters']} returns"
    return "agrees", ""


def chaotic(verdict, run):
    claimed = verdict["exponents"][0]
    length = run["t"] / 16
    if at_rest(run):
        return "contradicted", "the shape rests"
    rate, error = growth(run["windows"][1:], length)
    quiet = [abs(window["growth"]) < 4 for window in run["windows"]]
    if all(quiet[-3:]) and claimed["value"] * length > 10:
        ended = max((i + 1 for i, q in enumerate(quiet) if not q), default=0) * length
        status = "transient" if ended > verdict["time"] else "contradicted"
        return status, f"chaos ends at t = {ended:.5g}"
    if rate > 2 * error and rate > 0.5 * claimed["value"]:
        return "agrees", ""
    if rate + error < 0.5 * (claimed["value"] - claimed["error"]):
        return "contradicted", f"neighbouring orbits separate at {rate:.3g} +- {error:.2g}, not {claimed['value']:.3g}"
    return "undecided", f"neighbouring orbits separate at {rate:.3g} +- {error:.2g}"


def cycle(verdict, run):
    starts = [burst[0] for burst in run["bursts"]]
    gaps = [b - a for a, b in zip(starts, starts[1:])]
    if len(gaps) < 3:
        return "undecided", "too few rests"
    if low(run, "rate") > 1e-3 * run["fastest"]:
        return "contradicted", f"never at rest: {low(run, 'rate'):.2g} of {run['fastest']:.2g}"
    bursts = run["bursts"][1:]  # the first is how the body leaves its start
    turns = [math.degrees(b[1] - a[1]) for a, b in zip(bursts, bursts[1:])][-6:]
    if any(abs(turn - 90 * round(turn / 90)) > 2 for turn in turns):
        return "contradicted", f"turns of {', '.join(f'{turn:.1f}' for turn in turns)} degrees"
    rests = [gap for gap in gaps if gap > 0.2 * max(gaps)]  # the others lie between the two halves of a turn
    if rests[-1] < 0.5 * max(rests):
        return "contradicted", f"rests become shorter: {rests[-1]:.4g} after {max(rests):.4g}"
    return "agrees", ""
