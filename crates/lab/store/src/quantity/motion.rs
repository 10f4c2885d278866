//! A motion: rows of scans, cells of atlases, points of branches, sweeps.

super::quantities! {
    // Its place.
    CELL "cell" NUMBER "number of the cell: i1 + n1 i2 for place i1 on the first axis";
    SAMPLE "sample" NUMBER "number of the initial state";
    BRANCH "branch" NUMBER "number of the branch, from 0";
    POINT "point" NUMBER "number of the point along the branch, from 0";
    UP "up" NUMBER "1 where the parameter was swept upwards, 0 downwards";

    // Its kind.
    REGIME "regime" NUMBER "the motion";
    ATTRACTOR "attractor" NUMBER "the kind of reduced attractor";
    COURSE "course" NUMBER
        "sense of rotation, or direction to the field, where the model has no mirror or has a field; otherwise empty";
    MOTION "motion" NUMBER "kind of motion";
    FORM "form" NUMBER "symmetry of a motion that repeats, empty for the others";
    SPECIAL "special" NUMBER "what happens here, empty at ordinary points";
    STABLE "stable" NUMBER "1 where small deviations die out";
    UNSTABLE "unstable" NUMBER
        "number of growing directions of the reduced motion; at a special point without the critical ones";
    WHY "why" NUMBER "the evidence in one sentence";
    ROWS "rows" NUMBER "initial states that lead to it";
    COMPUTED "computed" NUMBER "1 if the cell was computed, 0 if it was taken from cells around it with the same motions";

    // Its numbers.
    MARGIN "margin" NUMBER
        "how clear the decision is: its number's distance from the limit, in units of its own uncertainty";
    SPEED "speed", "mean speed" SPEED
        "mean speed; undefined where the run ended early, and where the boundary of the shape cannot be closed";
    SPEED_MEAN "speed_mean", "mean speed" SPEED "time average of |v|";
    SPEED_MIN "speed_min", "smallest speed" SPEED "smallest |v|";
    SPEED_MAX "speed_max", "largest speed" SPEED "largest |v|";
    TURNING_RATE "turning_rate", "mean turning rate" TURNING "mean turning rate of the heading";
    PERIOD "period" TIME "time after which the body is as it was, but for the net rotation";
    NET_ROTATION "net_rotation", "net rotation per period" ANGLE "net rotation of the body per period (rad, in -pi..pi)";
    DRIFT "drift" LENGTH "distance travelled per period";
    HEADING "heading" ANGLE "direction of the displacement (rad from the x-axis), where rotations are no symmetry";
    SWING "swing" ANGLE "peak-to-peak swing of the heading over one period";
    SIZE "size", "largest size |*u*| of the shape" MIXED
        "largest size |u| of the shape, velocity included where it is an unknown";
    LAMBDA_1 "lambda_1", "*λ*_1" RATE "largest Lyapunov exponent";
    LAMBDA_1_ERROR "lambda_1_error" RATE "half width of its 95 % confidence interval";
    LEADING_RE "leading_re" MIXED "leading eigenvalue, or multiplier of an orbit: real part";
    LEADING_IM "leading_im" MIXED "its imaginary part";
    SLOPE "slope" MIXED "derivative of the parameter by the length along the branch";
    ESCAPE_TIME "escape_time" TIME "the blow-up time t*";
    TIME "time" TIME "model time that the decision took";
    RESOLUTION "resolution" NUMBER
        "largest relative change of speed, turning rate and period (of chaos: speed and largest exponent) \
        with half as many modes more, where the model has a number of modes";
}
