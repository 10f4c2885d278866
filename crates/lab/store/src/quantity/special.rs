//! A special point of motions in a plane: points of curves along which a motion is critical.

super::quantities! {
    CURVE "curve" NUMBER "number of the curve, from 0";
    POINT "point" NUMBER "number of the point along the curve, from 0";
    ARCLENGTH "arclength" MIXED "length along the curve from where it was begun, in the units of the continuation";
    KIND "kind" NUMBER "what is critical along the curve";
    MOTION "motion" NUMBER "the motion whose stability it bounds";
    CODIMENSION_2 "codimension_2" NUMBER "what else happens here, empty at ordinary points";
    UNSTABLE "unstable" NUMBER "number of growing directions of the reduced motion, without the critical ones";
    PERIOD "period" TIME "period of the reduced motion, at a Hopf bifurcation of the one that begins";
    CRITICAL_RE "critical_re" MIXED "the eigenvalue, or multiplier of an orbit, that is critical: real part";
    CRITICAL_IM "critical_im" MIXED "its imaginary part";
    FIRST_LYAPUNOV "first_lyapunov" MIXED "first Lyapunov coefficient of a Hopf bifurcation: below 0 supercritical";
    FIRST_LYAPUNOV_ERROR "first_lyapunov_error" MIXED "its error";
    ANGLE "angle" ANGLE "angle of the critical multipliers of a torus";
    RESIDUAL "residual" MIXED "what is left of the condition that holds along the curve";
    TRANSVERSALITY "transversality" MIXED
        "slope of the condition across the curve: residual / transversality is the distance from where it holds";
}
