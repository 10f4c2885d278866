//! A frame of a tracked cell, in the units of the data.

super::quantities! {
    CELL "cell" NUMBER "name of the cell";
    FRAME "frame" NUMBER "number of the frame";
    T "t", "*t*" TIME "time";
    X "x", "*x*" LENGTH "centre of the modes";
    Y "y", "*y*" LENGTH "centre of the modes";
    R0 "r0", "*R*_0" LENGTH "mean radius";
    AREA "area" AREA "area of the outline";
    PERIMETER "perimeter" LENGTH "length of the outline";
    ASPECT_RATIO "aspect_ratio", "aspect ratio" NUMBER "longer over shorter axis";
    SOLIDITY "solidity" NUMBER "area over that of the convex hull";
    CIRCULARITY "circularity" NUMBER "4 pi area/perimeter^2";
    CENTROID_X "centroid_x" LENGTH "centroid of the area";
    CENTROID_Y "centroid_y" LENGTH "centroid of the area";
    SPEED "speed" SPEED "displacement of the centroid to the next frame over the time between them";
    SIGMA "sigma" LENGTH "noise of a vertex";
    Z2_RE "z2_re" LENGTH "mode of the outline";
    Z2_IM "z2_im" LENGTH "mode of the outline";
    Z3_RE "z3_re" LENGTH "mode of the outline";
    Z3_IM "z3_im" LENGTH "mode of the outline";
    Z4_RE "z4_re" LENGTH "mode of the outline";
    Z4_IM "z4_im" LENGTH "mode of the outline";
    Z5_RE "z5_re" LENGTH "mode of the outline";
    Z5_IM "z5_im" LENGTH "mode of the outline";
    Z2_ERROR "z2_error" LENGTH "standard error of the real part";
    Z3_ERROR "z3_error" LENGTH "standard error of the real part";
    LEFT_OUT "left_out" NUMBER "1 where the frame does not count";
    SEEN "seen" NUMBER "1 where place and form of the outline count";
    FLAGS "flags" NUMBER "what is wrong with the frame";
}
