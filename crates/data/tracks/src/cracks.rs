//! The edges between full and empty pixels.

/// Corners of pixels around the full ones, anticlockwise in (x, y), from the lower left corner of `start` on:
/// a full pixel without one below or to the left of it in its row. Full pixels lie to the left. `diagonal`:
/// whether pixels that touch at a corner belong together.
pub(crate) fn follow(start: [i64; 2], diagonal: bool, full: impl Fn(i64, i64) -> bool) -> Vec<[i64; 2]> {
    const STEPS: [[i64; 2]; 4] = [[1, 0], [0, 1], [-1, 0], [0, -1]];
    // the pixels ahead, to the left and right of an edge that leaves a corner in each direction
    const LEFT: [[i64; 2]; 4] = [[0, 0], [-1, 0], [-1, -1], [0, -1]];
    let (mut at, mut direction, mut path) = (start, 0_usize, Vec::new());
    loop {
        path.push(at);
        at = [at[0] + STEPS[direction][0], at[1] + STEPS[direction][1]];
        let ahead = |direction: usize| full(at[0] + LEFT[direction][0], at[1] + LEFT[direction][1]);
        let right = |direction: usize| ahead((direction + 3) % 4);
        // turn right where the pixel to the right ahead is full (and touches more than a corner, or diagonal
        // ones belong together), go on where the left one is, else turn left
        direction = match (right(direction), ahead(direction)) {
            (true, touches) if touches || diagonal => (direction + 3) % 4,
            (_, true) => direction,
            _ => (direction + 1) % 4,
        };
        if at == start && direction == 0 {
            return path;
        }
    }
}
