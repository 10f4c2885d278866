//! A tracked cell, in the units of the data; NAME_low and NAME_high are the ends of the 95 % interval of a number, such as `speed_low`.

super::quantities! {
    CELL "cell" NUMBER "name of the cell";
    MOTION "motion" NUMBER "observed motion";
    SEEN "seen" NUMBER "frames whose outline is seen";
    SPEED "speed" SPEED
        "Mean length of the displacements over their duration. Among the numbers without a model from frame to frame: errors of the \
        places raise it, turns between frames lower it. Of the observed motion over the step, the least number of frames over which \
        95 % of the displacements are 5 times their error.";
    RMS_SPEED "rms_speed", "rms speed" SPEED
        "Root mean square of the displacements from frame to frame over the sampling interval, with the part of the errors of the \
        places, 4 sigma^2, subtracted.";
    PATH "path" LENGTH
        "Sum of the displacements of the centroid from each frame that is seen to the next; straight across gaps.";
    NET_DISPLACEMENT "net_displacement", "displacement" LENGTH "Net displacement, the sum over pieces of the record.";
    DIRECTIONALITY "directionality" NUMBER
        "Net displacement over path. It falls with the length of the record: compare records of equal length.";
    TURNING_COSINE "turning_cosine", "turning cosine" NUMBER
        "Mean cosine of the angle between displacements in a row: 1 straight on, 0 without memory, below 0 back. Errors of the places \
        lower it.";
    TURNING_RATE "turning_rate", "turning rate" TURNING
        "Mean rate of change of the heading, the direction of the displacements; positive anticlockwise in the coordinates of the \
        data. Among the numbers without a model from frame to frame; of the observed motion over the step, with the error of the \
        mean of eight blocks of the record.";
    PERSISTENCE "persistence" TIME
        "Persistence time P of the persistent random walk of highest likelihood through the places, with their errors as a third \
        number (Kalman filter, whatever the gaps); its interval is that of the profile of the likelihood. Without an interval where \
        innovations are not white: the cell is no such walk.";
    DIFFUSION "diffusion" DIFFUSION
        "D = S^2 P/2 of the same walk: at late times the mean-square displacement is 4 D *t*.";
    POSITION_ERROR "position_error", "localisation error" LENGTH
        "Standard deviation of the error of a coordinate of the centroid, from the same fit: what does not last from one frame to \
        the next.";
    AREA "area" AREA "Area of the outline, its mean over the frames that are seen.";
    PERIMETER "perimeter" LENGTH "Length of the outline, its mean over the frames that are seen.";
    ASPECT_RATIO "aspect_ratio", "aspect ratio" NUMBER
        "Longer over shorter axis of the ellipse with the same second moments of the area.";
    SOLIDITY "solidity" NUMBER "Area over that of the convex hull.";
    CIRCULARITY "circularity" NUMBER
        "4π area/perimeter^2: 1 for a circle. Outlines along the edges of pixels have longer perimeters: a disc of pixels 0.62.";
}
