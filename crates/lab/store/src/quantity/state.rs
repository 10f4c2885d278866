//! A state at a time: trajectories, crossings of sections.

super::quantities! {
    T "t", "*t*" TIME "model time";
    X "x", "*x*" LENGTH "position of the centre of mass";
    Y "y", "*y*" LENGTH "position of the centre of mass";
    SPEED "speed", "speed |***v***|" SPEED "|v|";
    TURNING_RATE "turning_rate", "turning rate" TURNING
        "d(heading)/dt (rad per model time); where noise acts on the velocity, the change of the heading since the row before over the time \
         between; undefined at rest, and where the velocity is that of a shape under noise";
    RISING "rising" NUMBER "1 where the coordinate grows, 0 where it falls";
}
