//! States in lanes: a shape, or a shape and its position.

use super::propagate::InLanes;
use crate::{Bundle, InPlane, VectorField};

/// The extent of a member's state: the shape alone, or the shape and the position.
pub trait Extent {
    /// Numbers of the position behind the shape.
    const POSITION: usize;

    /// `true` if rows are recorded. (A kernel without rows takes half as long to compile.)
    const ROWS: bool;

    /// The field of such states.
    type Field<F: InLanes, B: Bundle>: VectorField<B>;

    /// The field of states whose shape has this one.
    fn field<F: InLanes, B: Bundle>(shape: F::Field<B>) -> Self::Field<F, B>;

    /// The field of the shape.
    fn shape<F: InLanes, B: Bundle>(field: &mut Self::Field<F, B>) -> &mut F::Field<B>;
}

/// The shape alone: for a stretch whose path is not needed.
#[derive(Clone, Copy, Debug)]
pub struct ShapeAlone;

impl Extent for ShapeAlone {
    const POSITION: usize = 0;
    const ROWS: bool = false;
    type Field<F: InLanes, B: Bundle> = F::Field<B>;

    #[inline(always)]
    fn field<F: InLanes, B: Bundle>(shape: F::Field<B>) -> Self::Field<F, B> {
        shape
    }

    #[inline(always)]
    fn shape<F: InLanes, B: Bundle>(field: &mut Self::Field<F, B>) -> &mut F::Field<B> {
        field
    }
}

/// The shape, then the position.
#[derive(Clone, Copy, Debug)]
pub struct WithPosition;

impl Extent for WithPosition {
    const POSITION: usize = 2;
    const ROWS: bool = true;
    type Field<F: InLanes, B: Bundle> = InPlane<F::Field<B>>;

    #[inline(always)]
    fn field<F: InLanes, B: Bundle>(shape: F::Field<B>) -> Self::Field<F, B> {
        InPlane(shape)
    }

    #[inline(always)]
    fn shape<F: InLanes, B: Bundle>(field: &mut Self::Field<F, B>) -> &mut F::Field<B> {
        &mut field.0
    }
}
