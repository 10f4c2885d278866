//! Numbers of analyses that no table has: verdicts, exponents, equilibria, statistics. JSON and Python have them.

super::quantities! {
    // Of a motion.
    TURNING_ERROR "turning_error" TURNING "half width of the 95 % confidence interval of the mean turning rate";
    LASTED "lasted" TIME "of chaos: time for which it was observed to last, at least";
    RESTS "rests" TIME "durations of the rests";
    SADDLE "saddle" RATE "rates of the saddles of a heteroclinic cycle";
    EXPONENTS "exponents" RATE "Lyapunov exponents, largest first";
    VALUES "values" RATE "the same in Python";
    ERRORS "errors" RATE "their errors in Python";
    TRANSIENT "transient" TIME "time that is left out before averages";
    EIGENVALUES "eigenvalues" RATE "eigenvalues of the linearisation of a steady motion";

    // Of tracks of bodies.
    MEAN_SPEED "mean_speed" SPEED "mean speed";
    PERSISTENCE "persistence" TIME "persistence time of the fitted persistent random walk";
    WALK_SPEED "walk_speed" SPEED "speed of the fitted persistent random walk";
    DIFFUSION "diffusion" DIFFUSION "diffusion coefficient of the fitted persistent random walk";
    LATE_DIFFUSION "late_diffusion" DIFFUSION "diffusion coefficient from the slope of the mean-square displacement";
    GREEN_KUBO "green_kubo" DIFFUSION "diffusion coefficient from the correlation of the velocity";
    CORRELATION_TIMES "correlation_times" TIME "integral correlation times by quantity";
}
