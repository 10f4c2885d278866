//! Several figures as panels with letters, on one sheet.

use super::block::Block;
use super::error::{FigureError, Result};
use super::figure::Figure;
use super::geometry::{Point, Rect};
use super::room::Room;
use super::style::PER_POINT;
use super::svg::Svg;

/// Width of a panel where the sheet has no width, in pixels.
const WIDE: f64 = 420.0;
const MARGIN: f64 = 14.0;
/// Room above a panel for its letter, beside its legend, in pixels.
const LETTER: f64 = 17.0;
/// Millimetres on paper in a unit of a drawing.
const MILLIMETRES: f64 = 25.4 / 72.0 / PER_POINT;
/// The largest rounding of the widths of sheets, upwards.
const ROUNDED: f64 = 4.0;
/// The number of rounds in which the panels are laid out until their frames are aligned.
const ROUNDS: usize = 3;

/// Figures in rows of equal panels, (a), (b), and so on. Frames in a column begin at the same place; those in a row have the same
/// height. Titles and captions of the panels are part of the caption.
pub struct Panels {
    /// Line above the panels.
    pub title: String,
    /// Paragraphs below the panels.
    pub caption: Vec<String>,
    columns: usize,
    figures: Vec<Box<dyn Figure>>,
}

/// The letter of a panel: (a), (b), ...
fn letter(number: usize) -> String {
    let last = char::from(b'a' + (number % 26) as u8);
    format!("({last})")
}

/// The drawn panels: the frame of each, measured from the corner of its own sheet, and the size of that
/// sheet.
struct Drawn {
    panels: Vec<(Rect, [f64; 2])>,
    /// Least heights of the frames, where these were asked to be lower: their labels need it.
    floors: Vec<f64>,
    columns: usize,
}

impl Drawn {
    fn column(&self, of: usize) -> impl Iterator<Item = &Rect> {
        self.panels.iter().skip(of % self.columns).step_by(self.columns).map(|panel| &panel.0)
    }

    fn row(&self, of: usize) -> &[(Rect, [f64; 2])] {
        let first = of - of % self.columns;
        &self.panels[first..self.panels.len().min(first + self.columns)]
    }

    /// The displacement of a sheet by which its frame begins where those of its column and row do.
    fn shift(&self, of: usize) -> Point {
        let frame = self.panels[of].0;
        let left = self.column(of).map(|frame| frame.x).fold(0.0, f64::max);
        [left - frame.x, self.top(of) - frame.y]
    }

    /// Room above the frames of a row.
    fn top(&self, of: usize) -> f64 {
        self.row(of).iter().map(|panel| panel.0.y).fold(0.0, f64::max)
    }

    /// Height of a row.
    fn height(&self, of: usize) -> f64 {
        let top = self.top(of);
        self.row(of).iter().map(|(frame, size)| top - frame.y + size[1]).fold(0.0, f64::max)
    }

    /// Height of the frames of a row: that of the highest, but beside others none is higher than wide, unless one must be.
    fn frame(&self, of: usize) -> f64 {
        let row = self.row(of);
        let highest = row.iter().map(|panel| panel.0.h).fold(0.0, f64::max);
        let widest = row.iter().map(|panel| panel.0.w).fold(0.0, f64::max);
        let first = of - of % self.columns;
        let floor = self.floors[first..first + row.len()].iter().copied().fold(0.0, f64::max);
        if row.len() > 1 { highest.min(widest).max(floor) } else { highest }
    }

    /// The rooms in which frames are aligned, below `top`, the places of the letters, and where the last row ends.
    fn rooms(&self, wide: f64, mut top: f64) -> (Vec<Room>, Vec<Point>, f64) {
        let (mut rooms, mut letters) = (Vec::new(), Vec::new());
        for of in 0..self.panels.len() {
            let [x, y] = self.shift(of);
            let left = (of % self.columns) as f64 * wide;
            letters.push([left + MARGIN, top + MARGIN]);
            rooms.push(Room::panel(of, wide - x, Some(self.frame(of)), [left + x, top + LETTER + y]));
            if (of + 1) % self.columns == 0 || of + 1 == self.panels.len() {
                top += LETTER + self.height(of);
            }
        }
        (rooms, letters, top)
    }
}

impl Panels {
    /// Panels in rows of `columns`.
    pub fn new(columns: usize, mut figures: Vec<Box<dyn Figure>>) -> Self {
        let caption = figures.iter_mut().enumerate().map(|(of, figure)| {
            let (title, caption) = figure.words();
            let title = std::mem::take(title);
            let said = if title.is_empty() { String::new() } else { format!("{title}. ") };
            format!("{} {said}{}", letter(of), std::mem::take(caption).join(" "))
        });
        Self { title: String::new(), caption: caption.collect(), columns: columns.max(1), figures }
    }

    fn draw(&self, rooms: &[Room]) -> Result<Vec<Svg>> {
        self.figures.iter().zip(rooms).map(|(figure, room)| figure.sheet(*room)).collect()
    }
}

impl Figure for Panels {
    fn sheet(&self, room: Room) -> Result<Svg> {
        if self.figures.is_empty() {
            return Err(FigureError::Empty { what: "list of panels" });
        }
        let wide = room.width().map_or(WIDE, |width| width / self.columns as f64);
        let all = wide * self.columns as f64;
        let (title, caption) = (
            Block::title(&self.title, all - 2.0 * MARGIN),
            Block::caption(&self.caption, all - 2.0 * MARGIN),
        );
        let mut rooms: Vec<Room> =
            (0..self.figures.len()).map(|of| Room::panel(of, wide, None, [0.0; 2])).collect();
        let (mut letters, mut bottom) = (Vec::new(), 0.0);
        let mut floors = vec![0.0; self.figures.len()];
        // frames of other heights may have other labels, and these other margins
        for _ in 0..ROUNDS {
            let panels: Vec<(Rect, [f64; 2])> =
                self.draw(&rooms)?.iter().map(|sheet| (sheet.framed(), sheet.size())).collect();
            for ((floor, room), (frame, _)) in floors.iter_mut().zip(&rooms).zip(&panels) {
                if room.height().is_some_and(|asked| frame.h > asked + 0.01) {
                    *floor = frame.h;
                }
            }
            let drawn = Drawn { panels, floors: floors.clone(), columns: self.columns };
            (rooms, letters, bottom) = drawn.rooms(wide, title.height());
        }
        let foot = if self.caption.is_empty() { 0.0 } else { caption.height() + MARGIN };
        let mut whole = Svg::in_room(room, all.ceil(), (bottom + foot).ceil());
        title.draw(&mut whole, [MARGIN; 2]);
        for (of, sheet) in self.draw(&rooms)?.iter().enumerate() {
            let beside = rooms[of].corner()[0] - (of % self.columns) as f64 * wide;
            let needed = sheet.size()[0] + beside;
            if needed > wide + ROUNDED {
                let [needed, given] = [needed, wide].map(|units| units * MILLIMETRES);
                return Err(FigureError::Narrow { panel: letter(of), needed, given });
            }
            whole.include(sheet);
        }
        for (of, at) in letters.into_iter().enumerate() {
            Block::title(&letter(of), wide).draw(&mut whole, at);
        }
        caption.draw(&mut whole, [MARGIN, bottom]);
        Ok(whole)
    }

    /// The tables of the panels, one after another.
    fn data(&self) -> String {
        let tables = self.figures.iter().enumerate();
        tables.map(|(of, figure)| format!("# {}\n{}", letter(of), figure.data())).collect()
    }

    fn words(&mut self) -> (&mut String, &mut Vec<String>) {
        (&mut self.title, &mut self.caption)
    }
}
