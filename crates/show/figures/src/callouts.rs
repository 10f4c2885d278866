//! Labels of points in a plane: words where there is room beside the point, a number with a key where there is none.

use super::geometry::{Point, Rect};
use super::glyph::Glyph;
use super::paint::Paint;
use super::palette::{INK, WHITE};
use super::svg::{Anchor, Svg};
use super::text::Label;

/// Size of the letters, in pixels.
const SIZE: f64 = 12.0;
/// Half of the side of the square that a point takes, in pixels.
pub(crate) const POINT: f64 = 6.0;
/// Distances of a label from its point, in pixels: the words lie at the first ones alone.
const GAPS: [f64; 5] = [2.0, 5.0, 10.0, 16.0, 24.0];
/// The number of the distances that are near enough for words.
const NEAR: usize = 2;
/// From this distance between ring and label on a line leads from the point to the label, in pixels.
const LED: f64 = 4.0;
/// Radius of the ring at a point, in pixels.
const RING: f64 = 4.2;
/// Points with one number that are closer than this have it once, in pixels.
const TOGETHER: f64 = 20.0;

/// The surroundings of labels, which they must not hide.
#[derive(Debug, Clone)]
pub(crate) struct Around<'a> {
    /// The frame in which labels may lie.
    pub(crate) frame: Rect,
    /// The rectangles of other labels and of points.
    pub(crate) taken: Vec<Rect>,
    /// Lines, in pixels.
    pub(crate) lines: &'a [Vec<Point>],
}

impl Around<'_> {
    /// Returns `true` if a place lies in the frame and hides no label and no point.
    fn is_free(&self, place: &Rect) -> bool {
        let Rect { x, y, .. } = self.frame;
        let inside = place.x >= x
            && place.y >= y
            && place.right() <= self.frame.right()
            && place.bottom() <= self.frame.bottom();
        inside && self.taken.iter().all(|other| apart(place, other))
    }

    /// Returns `true` if it hides no line either.
    pub(crate) fn is_clear(&self, place: &Rect) -> bool {
        let hides = |line: &Vec<Point>| line.windows(2).any(|pair| crosses(place, pair[0], pair[1]));
        self.is_free(place) && !self.lines.iter().any(hides)
    }

    /// The first place of a size beside a point that is clear; with `anyhow`, one on lines or, in the end, the first of all.
    pub(crate) fn place(&self, at: Point, size: [f64; 2], gaps: &[f64], anyhow: bool) -> Option<Rect> {
        let all = || gaps.iter().flat_map(|gap| beside(at, size, *gap));
        let clear = all().find(|place| self.is_clear(place));
        let free = || all().find(|place| self.is_free(place)).or_else(|| all().next());
        clear.or_else(|| if anyhow { free() } else { None })
    }
}

/// A label with its place.
#[derive(Debug, Clone)]
struct Placed {
    point: Point,
    words: Label,
    place: Rect,
}

impl Placed {
    /// The line from the point to the nearest place of its label, where that is not beside the ring.
    fn leader(&self) -> Option<[Point; 2]> {
        let Rect { x, y, .. } = self.place;
        let [a, b] = self.point;
        let near = [a.clamp(x, self.place.right()), b.clamp(y, self.place.bottom())];
        ((near[0] - a).hypot(near[1] - b) - RING > LED).then_some([self.point, near])
    }
}

/// The labels of points, and which of them are numbers.
#[derive(Debug, Clone, Default)]
pub(crate) struct Callouts {
    /// All points, also those without a label of their own.
    points: Vec<Point>,
    labels: Vec<Placed>,
    /// The texts that the numbers stand for, from 1 on.
    pub(crate) key: Vec<String>,
}

impl Callouts {
    /// Places the labels (markup) of points, and says `around` what they take: those with one text that does not fit have one number, and
    /// have it once where they are close to each other.
    pub(crate) fn new(points: &[(Point, &str)], around: &mut Around<'_>) -> Self {
        let mut all = Self { points: points.iter().map(|one| one.0).collect(), ..Self::default() };
        let mut narrow = Vec::new();
        for (point, text) in points {
            let words = Label::parse(text);
            match around.place(*point, size(&words), &GAPS[..NEAR], false) {
                Some(found) => all.put(*point, words, found, around),
                None => narrow.push((*point, *text)),
            }
        }
        for (point, text) in narrow {
            let known = all.key.iter().position(|other| other == text);
            let number = known.unwrap_or(all.key.len()) + 1;
            if known.is_none() {
                all.key.push(text.to_owned());
            }
            let words = Label::parse(&number.to_string());
            let near = |[x, y]: Point| libm::hypot(x - point[0], y - point[1]) < TOGETHER;
            if all.labels.iter().any(|label| label.words == words && near(label.point)) {
                continue;
            }
            if let Some(found) = around.place(point, size(&words), &GAPS, true) {
                all.put(point, words, found, around);
            }
        }
        all
    }

    fn put(&mut self, point: Point, words: Label, place: Rect, around: &mut Around<'_>) {
        around.taken.push(place);
        self.labels.push(Placed { point, words, place });
    }

    /// Draws the labels, then the points, so that no label hides one. `corner` is where the frame lies on the sheet.
    pub(crate) fn draw(&self, svg: &mut Svg, [dx, dy]: Point) {
        let moved = |place: &Rect| Rect { x: place.x + dx, y: place.y + dy, ..*place };
        for [from, to] in self.labels.iter().filter_map(Placed::leader) {
            let line = [from, to].map(|[x, y]| [x + dx, y + dy]);
            svg.line(line[0], line[1], &Paint::stroke(WHITE, 3.0).opacity(0.85));
            svg.line(line[0], line[1], &Paint::stroke(INK, 1.0));
        }
        for Placed { words, place, .. } in &self.labels {
            let place = moved(place);
            svg.rect(place, &Paint::fill(WHITE).opacity(0.85));
            let at = [place.x + 2.0, place.y + 0.5 * place.h + 0.36 * SIZE];
            svg.text(at, SIZE, Anchor::Start, words);
        }
        for [x, y] in &self.points {
            Glyph::Ring.draw(svg, [x + dx, y + dy], RING, INK);
        }
    }
}

/// The rectangle that a point takes.
pub(crate) fn taken([x, y]: Point) -> Rect {
    Rect { x: x - POINT, y: y - POINT, w: 2.0 * POINT, h: 2.0 * POINT }
}

fn size(words: &Label) -> [f64; 2] {
    [words.width(SIZE) + 4.0, SIZE + 3.0]
}

/// The places of a label around a point: to the right and above first.
fn beside([x, y]: Point, [w, h]: [f64; 2], gap: f64) -> [Rect; 8] {
    let away = POINT + gap;
    let (right, left, above, below) = (x + away, x - away - w, y - away - h, y + away);
    let (across, level) = (x - 0.5 * w, y - 0.5 * h);
    let corners = [
        [right, above],
        [right, below],
        [left, above],
        [left, below],
        [right, level],
        [left, level],
        [across, above],
        [across, below],
    ];
    corners.map(|[x, y]| Rect { x, y, w, h })
}

fn apart(a: &Rect, b: &Rect) -> bool {
    a.right() <= b.x || b.right() <= a.x || a.bottom() <= b.y || b.bottom() <= a.y
}

/// Returns `true` if a segment has a part in a box.
fn crosses(place: &Rect, from: Point, to: Point) -> bool {
    !super::clip::clip(&[from, to], *place).is_empty()
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRAME: Rect = Rect { x: 0.0, y: 0.0, w: 300.0, h: 200.0 };

    fn places(points: &[(Point, &str)], lines: &[Vec<Point>]) -> Callouts {
        let taken = points.iter().map(|(at, _)| taken(*at)).collect();
        Callouts::new(points, &mut Around { frame: FRAME, taken, lines })
    }

    #[test]
    fn words_stand_beside_a_point_and_numbers_where_they_do_not_fit() {
        let alone = places(&[([150.0, 100.0], "Bogdanov-Takens")], &[]);
        assert!(alone.key.is_empty() && alone.labels.len() == 1);
        // eleven points on a line have room for some words, the others have one number
        let crowd: Vec<_> =
            (0..11).map(|i| ([20.0 + 26.0 * f64::from(i), 100.0], "Bogdanov-Takens")).collect();
        let found = places(&crowd, &[]);
        assert_eq!((found.key.len(), found.labels.len()), (1, 11), "{found:?}");
        let boxes: Vec<Rect> = found.labels.iter().map(|label| label.place).collect();
        for (i, one) in boxes.iter().enumerate() {
            assert!(boxes[..i].iter().all(|other| apart(one, other)), "{one:?} overlaps");
            assert!(crowd.iter().all(|(at, _)| apart(one, &taken(*at))), "{one:?} hides a point");
        }
    }

    #[test]
    fn points_of_one_number_that_are_close_have_it_once() {
        let crowd: Vec<_> =
            (0..6).map(|i| ([150.0 + 3.0 * f64::from(i), 100.0], "Bogdanov-Takens")).collect();
        let found = places(&crowd, &[vec![[0.0, 85.0], [300.0, 85.0]], vec![[0.0, 115.0], [300.0, 115.0]]]);
        let numbers = found.labels.iter().filter(|label| label.words == Label::parse("1")).count();
        assert_eq!((found.points.len(), numbers), (6, 1), "{found:?}");
    }

    #[test]
    fn words_lie_on_no_boundary() {
        // no room for words between or beside the lines near the point, some for a number beyond them
        let line = [96.0, 85.0, 115.0].map(|y| vec![[0.0, y], [300.0, y]]);
        let found = places(&[([150.0, 100.0], "Bogdanov-Takens"), ([30.0, 30.0], "Bautin")], &line);
        assert_eq!(found.key, ["Bogdanov-Takens"]);
        for label in &found.labels {
            let Rect { x, y, w, h } = label.place;
            let hit = |line: &Vec<Point>| crosses(&Rect { x, y, w, h }, line[0], line[1]);
            assert!(!line.iter().any(hit), "{label:?}");
        }
    }

    #[test]
    fn a_label_that_is_not_beside_its_ring_is_led_to() {
        let words = Label::parse("Bautin");
        let [w, h] = size(&words);
        let at =
            |x: f64, y: f64| Placed { point: [0.0, 0.0], words: words.clone(), place: Rect { x, y, w, h } };
        assert_eq!(at(POINT + GAPS[0], -0.5 * h).leader(), None);
        // above and to the right: farther from the ring than from the square around it
        let corner = at(POINT + GAPS[0], -h - POINT - GAPS[0]).leader().expect("a line");
        assert_eq!(corner, [[0.0, 0.0], [POINT + GAPS[0], -POINT - GAPS[0]]]);
    }
}
