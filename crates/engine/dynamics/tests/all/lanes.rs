//! Vector registers against `f64`: every operation, on every instruction set of this machine.

use motiform_dynamics::scalar::MOST_LANES;
use motiform_dynamics::simd::{InstructionSet, LaneKernel, run_lanes_on};
use motiform_dynamics::{Bundle, Mask};
use proptest::prelude::*;

const NUMBERS: usize = 21;
const MASKS: usize = 7;

/// The results of one bundle: numbers lane by lane, and masks.
struct Results {
    lanes: usize,
    numbers: [[f64; MOST_LANES]; NUMBERS],
    masks: [Mask; MASKS],
}

/// All operations on three numbers per lane.
struct Operations<'i>(&'i [[f64; MOST_LANES]; 3]);

impl LaneKernel for Operations<'_> {
    type Output = Results;

    #[inline(always)]
    fn run<B: Bundle>(self) -> Results {
        let (a, b, c) = (B::load(&self.0[0]), B::load(&self.0[1]), B::load(&self.0[2]));
        let mask = Mask(0b1010_0110_0101_1001);
        let (sin, cos) = c.sin_cos();
        let (mut sum, mut difference) = (a, a);
        sum += b;
        difference -= b;
        let all = [
            a + b,
            a - b,
            a * b,
            a / b,
            a * 0.3,
            -a,
            a.mul_add(b, c),
            a.add_scaled(b, c),
            a.scale(b),
            a.abs(),
            a.abs().sqrt(),
            a.exp(),
            a.abs().ln(),
            a.max(b),
            a.min(b),
            B::select(mask, a, b),
            a.with_lane(0, 7.0),
            sum,
            difference,
            sin,
            cos,
        ];
        let mut numbers = [[0.0; MOST_LANES]; NUMBERS];
        for i in 0..NUMBERS {
            all[i].store(&mut numbers[i]);
        }
        let masks =
            [a.less(b), a.at_most(b), a.finite(), a.less(a), a.at_most(a), a.less(b) | b.less(a), !a.less(b)];
        Results { lanes: B::LANES, numbers, masks }
    }
}

/// The same over `f64`, one lane at a time.
fn expected(input: &[[f64; MOST_LANES]; 3], lane: usize) -> ([f64; NUMBERS], [bool; MASKS]) {
    let [a, b, c] = input.map(|lanes| lanes[lane]);
    let mask = Mask(0b1010_0110_0101_1001);
    let numbers = [
        a + b,
        a - b,
        a * b,
        a / b,
        a * 0.3,
        -a,
        a * b + c,
        c * b + a,
        b * a,
        a.abs(),
        a.abs().sqrt(),
        libm::exp(a),
        libm::log(a.abs()),
        if a < b { b } else { a },
        if b < a { b } else { a },
        if mask.has(lane) { a } else { b },
        if lane == 0 { 7.0 } else { a },
        a + b,
        a - b,
        libm::sin(c),
        libm::cos(c),
    ];
    (
        numbers,
        [
            a < b,
            a <= b,
            a.is_finite(),
            false,
            !a.is_nan(),
            a < b || b < a,
            a.is_nan() || b.is_nan() || a >= b,
        ],
    )
}

fn check(input: &[[f64; MOST_LANES]; 3]) {
    for set in InstructionSet::available() {
        compare(input, &run_lanes_on(set, Operations(input)), set);
    }
}

fn compare(input: &[[f64; MOST_LANES]; 3], got: &Results, how: InstructionSet) {
    for lane in 0..got.lanes {
        let (numbers, masks) = expected(input, lane);
        for (i, expected) in numbers.into_iter().enumerate() {
            let got = got.numbers[i][lane];
            let same = got.to_bits() == expected.to_bits() || got.is_nan() && expected.is_nan();
            assert!(same, "{how:?}, operation {i}, lane {lane}: {got:e}, not {expected:e}");
        }
        for (i, expected) in masks.into_iter().enumerate() {
            assert_eq!(got.masks[i].has(lane), expected, "{how:?}, mask {i}, lane {lane}");
        }
    }
}

proptest! {
    /// Ordinary numbers.
    #[test]
    fn operations_are_those_of_f64(input in prop::array::uniform3(prop::array::uniform16(-1e3..1e3_f64))) {
        check(&input);
    }
}

/// Zeros of both signs, infinities, what is not a number, the smallest and the largest.
#[test]
fn special_numbers_are_those_of_f64() {
    let special = [
        0.0,
        -0.0,
        1.0,
        -1.5,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::NAN,
        f64::MIN_POSITIVE,
        5e-324,
        f64::MAX,
        -3.25,
    ];
    for offset in 0..special.len() {
        let a = std::array::from_fn(|lane| special[lane % special.len()]);
        let b = std::array::from_fn(|lane| special[(lane + offset) % special.len()]);
        check(&[a, b, [0.5; MOST_LANES]]);
    }
}

/// One number in, a rough power of it out.
struct Power([f64; MOST_LANES], i64);

impl LaneKernel for Power {
    type Output = ([f64; MOST_LANES], usize);

    #[inline(always)]
    fn run<B: Bundle>(self) -> Self::Output {
        let mut out = [0.0; MOST_LANES];
        B::load(&self.0).rough_power(self.1).store(&mut out);
        (out, B::LANES)
    }
}

/// Powers are right to some per cent, and the same bits everywhere.
#[test]
fn rough_powers_are_rough_but_the_same_everywhere() {
    for numerator in [-28_i64, -22, -16, 5, 32, 51] {
        for exponent in -120..20 {
            let input = std::array::from_fn(|lane| (0.37 * f64::from(exponent) + 0.21 * lane as f64).exp());
            let exact = |x: f64| x.powf(numerator as f64 / 256.0);
            for set in InstructionSet::available() {
                let (got, lanes) = run_lanes_on(set, Power(input, numerator));
                for lane in 0..lanes {
                    let alone = Bundle::rough_power(input[lane], numerator);
                    assert_eq!(got[lane].to_bits(), alone.to_bits(), "{set:?} {numerator}");
                    let error = (alone / exact(input[lane]) - 1.0).abs();
                    assert!(error < 0.05, "{} to {numerator}/256: {error}", input[lane]);
                }
            }
        }
    }
}

#[test]
fn masks_list_their_lanes() {
    let mask = Mask(0b1000_0000_0010_0101);
    assert_eq!(mask.lanes().collect::<Vec<_>>(), [0, 2, 5, 15]);
    assert_eq!((!mask).lanes().count(), 12);
    assert!(mask.has(5) && !mask.has(4) && mask.any() && !Mask::default().any());
    assert_eq!(Mask::first(8) & mask, Mask(0b10_0101));
    assert_eq!(Mask::first(MOST_LANES), Mask(u16::MAX));
    assert_eq!(Mask::only(3) | Mask::only(0), Mask(0b1001));
    let mut both = mask;
    both &= Mask::only(2);
    both |= Mask::only(7);
    assert_eq!(both, Mask(0b1000_0100));
}
