//! A value of a statistic of tracks, such as a correlation at a lag; mean lives of chaos.

super::quantities! {
    QUANTITY "quantity" NUMBER "velocity, heading, speed, a mode, or turning_angle";
    LAG "lag", "lag *τ*" TIME "lag";
    LOWER "lower" MIXED "lower end of its 95 % interval";
    UPPER "upper" MIXED "upper end of its 95 % interval";
    MSD "msd", "⟨|***r***(*t*+*τ*) − ***r***(*t*)|^2⟩" AREA "mean-square displacement";
    EXPONENT "exponent", "d ln MSD / d ln *τ*" NUMBER "d ln msd / d ln lag";
    EXPONENT_LOWER "exponent_lower" NUMBER "lower end of its 95 % interval";
    EXPONENT_UPPER "exponent_upper" NUMBER "upper end of its 95 % interval";
    FIT "fit" AREA "fitted persistent random walk";
    WINDOWS "windows" NUMBER "overlapping windows averaged";
    CORRELATION "correlation", "*C*(*τ*)/*C*(0)" NUMBER "C(lag)/C(0)";
    FROM "from" MIXED "lower edge of the bin (model units, rad)";
    TO "to" MIXED "upper edge of the bin";
    COUNT "count" NUMBER "samples in the bin";
    DENSITY "density", "probability density" MIXED "probability density";
    FREQUENCY "frequency" RATE "cycles per model time";
    TURNING_ANGLE "turning_angle", "turning angle (degrees)" NUMBER "angle between displacements of one lag that follow one another";
    PER_DEGREE "per_degree", "probability density (per degree)" NUMBER "probability density of a turning angle";
    POWER "power", "power spectral density" MIXED "power spectral density (unit^2 x model time), summed over components";
    RADIUS "radius", "radius *r*" LENGTH "radius of the disc";
    MEAN "mean", "mean first-passage time" TIME "mean first-passage time";
    RESTRICTED "restricted" TIME "mean of min(time, limit)";
    LIMIT "limit" TIME "limit of the restricted mean";
    CENSORED "censored" NUMBER "share of the starts that were not watched until they left";
    STARTS "starts" NUMBER "starting times";
    LIFE "life", "mean life" TIME "mean life of transient chaos after the delay";
}
