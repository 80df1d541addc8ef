//! Ink map: the text of the receipt, rasterised once at the start.
//!
//! Method: glyph outlines of `ab_glyph` on a monospaced grid; the bar code is Interleaved 2 of 5.
//!
//! Reads [`receipt_text`]; writes one ink value per texel.
//!
//! Invariant: the margins have no ink.

use ab_glyph::{Font, FontRef, PxScale, ScaleFont, point};

use super::receipt_text::{self, Face, Line, WIDTH};

/// Size of the specified canvas [texels].
const CANVAS: [u32; 2] = [512, 768];
/// Texels along a side per texel of the specified canvas.
const SCALE: u32 = 3;
/// Left and top margins, in texels of the specified canvas.
const MARGIN: [f32; 2] = [38.0, 46.0];

/// Ink per texel, rows from the top: 0 is blank paper, 255 is full ink.
pub struct InkMap {
    /// Width and height [texels].
    pub size: [u32; 2],
    /// One value per texel.
    pub ink: Vec<u8>,
}

/// State of typesetting: fonts, ink map and the position of the next line.
struct Typesetter<'a> {
    plain: FontRef<'a>,
    heavy: FontRef<'a>,
    print: InkMap,
    /// Advance width of plain text [texels].
    pitch: f32,
    /// Top of the next line [texels].
    top: f32,
}

impl InkMap {
    /// Rasterises the receipt.
    pub fn new() -> Self {
        let size = CANVAS.map(|side| side * SCALE);
        let width = (CANVAS[0] as f32 - 2.0 * MARGIN[0]) * SCALE as f32;
        let (Ok(plain), Ok(heavy)) = (
            FontRef::try_from_slice(include_bytes!("../../fonts/JetBrainsMono-Medium.ttf")),
            FontRef::try_from_slice(include_bytes!("../../fonts/JetBrainsMono-ExtraBold.ttf")),
        ) else {
            unreachable!("the demo's own fonts");
        };
        let mut typesetter = Typesetter {
            plain,
            heavy,
            print: Self { size, ink: vec![0; (size[0] * size[1]) as usize] },
            pitch: width / WIDTH as f32,
            top: MARGIN[1] * SCALE as f32,
        };
        let lines = receipt_text::lines();
        // The line height fills the space between the margins.
        let free = size[1] as f32 - 2.0 * typesetter.top;
        let high: f32 = lines.iter().map(height).sum();
        let line = free / high;
        for text in &lines {
            typesetter.line(text, line * height(text), line);
        }
        typesetter.print
    }

    /// Returns the ink at a position; `x` and `y` are fractions of the sheet.
    pub fn at(&self, x: f32, y: f32) -> u8 {
        let [wide, high] = self.size;
        let texel = |share: f32, side: u32| ((share * side as f32) as u32).min(side - 1);
        self.ink[(texel(y, high) * wide + texel(x, wide)) as usize]
    }
}

impl Default for InkMap {
    fn default() -> Self {
        Self::new()
    }
}

/// Returns the height of a line, in lines of plain text.
fn height(line: &Line) -> f32 {
    match line {
        Line::Centred(_, Face::Title) => 2.3,
        Line::Spread(_, _, Face::Heavy) => 1.45,
        Line::Centred(..) | Line::Spread(..) => 1.0,
        Line::Rule => 0.9,
        Line::Gap => 0.45,
        Line::Bars(_) => 2.5,
    }
}

impl Typesetter<'_> {
    /// Rasterises a line of `high` texels; `line` is the height of plain text [texels].
    fn line(&mut self, text: &Line, high: f32, line: f32) {
        let left = MARGIN[0] * SCALE as f32;
        let right = self.print.size[0] as f32 - left;
        // The baseline; the rest of the line height is split above and below it.
        let base = self.top + 0.5 * high + 0.3 * line;
        let wide = |text: &str, pitch: f32| pitch * text.chars().count() as f32;
        match text {
            Line::Centred(text, face) => {
                let size_factor = if *face == Face::Title { 2.1 } else { 1.0 };
                let pitch = self.pitch * size_factor;
                let spacing = if *face == Face::Title { 1.18 } else { 1.0 };
                let start = 0.5 * (left + right - wide(text, pitch * spacing));
                self.text(
                    text,
                    [start, base + 0.25 * line * (size_factor - 1.0)],
                    pitch,
                    spacing,
                    *face,
                );
            }
            Line::Spread(a, b, face) => {
                let size_factor = if *face == Face::Heavy { 1.35 } else { 1.0 };
                let pitch = self.pitch * size_factor;
                self.text(a, [left, base], pitch, 1.0, *face);
                self.text(b, [right - wide(b, pitch), base], pitch, 1.0, *face);
            }
            Line::Rule => {
                let (dash, thick) = (self.pitch, 0.45 * SCALE as f32);
                let middle = self.top + 0.5 * high;
                for i in 0..WIDTH {
                    let from = left + (i as f32 + 0.18) * dash;
                    self.fill([from, middle - thick], [from + 0.64 * dash, middle + thick]);
                }
            }
            Line::Gap => {}
            Line::Bars(number) => self.bars(*number, high),
        }
        self.top += high;
    }

    fn text(&mut self, text: &str, [left, base]: [f32; 2], pitch: f32, spacing: f32, face: Face) {
        let font = if face == Face::Plain { &self.plain } else { &self.heavy };
        // In a monospaced font all glyphs have the same advance width.
        let unit = font.as_scaled(PxScale::from(1000.0));
        let scale = PxScale::from(1000.0 * pitch / unit.h_advance(font.glyph_id('0')));
        let mut x = left + 0.5 * (spacing - 1.0) * pitch;
        for character in text.chars() {
            let glyph = font.glyph_id(character).with_scale_and_position(scale, point(x, base));
            if let Some(outline) = font.outline_glyph(glyph) {
                let [dx, dy] = [outline.px_bounds().min.x, outline.px_bounds().min.y];
                let print = &mut self.print;
                outline.draw(|x, y, cover| {
                    print.ink_in([x as f32 + dx, y as f32 + dy], (cover.min(1.0) * 255.0) as u8);
                });
            }
            x += pitch * spacing;
        }
    }

    /// Rasterises an Interleaved 2 of 5 bar code: the bars encode one digit of a pair, the gaps
    /// between them the other.
    fn bars(&mut self, number: u64, high: f32) {
        let digits: Vec<usize> =
            format!("{number:014}").bytes().map(|digit| usize::from(digit - b'0')).collect();
        let mut widths = vec![1, 1, 1, 1];
        for pair in digits.chunks_exact(2) {
            for place in 0..5 {
                widths.extend(
                    [0, 1].map(|i| if WIDE[pair[i]] >> (4 - place) & 1 == 1 { 3 } else { 1 }),
                );
            }
        }
        widths.extend([3, 1, 1]);
        let modules: u32 = widths.iter().sum();
        let module = 2 * SCALE;
        let mut x = (self.print.size[0] - modules * module) / 2;
        let (top, bottom) = (self.top + 0.16 * high, self.top + 0.84 * high);
        for (i, width) in widths.into_iter().enumerate() {
            let to = x + width * module;
            if i % 2 == 0 {
                self.fill([x as f32, top], [to as f32, bottom]);
            }
            x = to;
        }
    }

    fn fill(&mut self, from: [f32; 2], to: [f32; 2]) {
        let [x, y] = [0, 1].map(|axis| from[axis].round() as u32..to[axis].round() as u32);
        for row in y {
            for column in x.clone() {
                self.print.ink_in([column as f32, row as f32], 255);
            }
        }
    }
}

/// Wide bars of each digit; the highest of the five bits is the first bar.
const WIDE: [u8; 10] =
    [0b00110, 0b10001, 0b01001, 0b11000, 0b00101, 0b10100, 0b01100, 0b00011, 0b10010, 0b01010];

impl InkMap {
    fn ink_in(&mut self, [x, y]: [f32; 2], ink: u8) {
        let [wide, high] = self.size;
        if x >= 0.0 && y >= 0.0 && x < wide as f32 && y < high as f32 {
            let texel = &mut self.ink[(y as u32 * wide + x as u32) as usize];
            *texel = (*texel).max(ink);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_margins_are_bare_and_the_middle_is_printed() {
        let print = InkMap::new();
        let [wide, high] = print.size.map(|side| side as usize);
        assert_eq!(print.ink.len(), wide * high);
        let inked = |x: [f32; 2], y: [f32; 2]| {
            let columns = (x[0] * wide as f32) as usize..(x[1] * wide as f32) as usize;
            let rows = (y[0] * high as f32) as usize..(y[1] * high as f32) as usize;
            rows.flat_map(|row| columns.clone().map(move |column| (row, column)))
                .filter(|(row, column)| print.ink[row * wide + column] > 127)
                .count()
        };
        for (x, y) in [
            ([0.0, 0.06], [0.0, 1.0]),
            ([0.94, 1.0], [0.0, 1.0]),
            ([0.0, 1.0], [0.0, 0.05]),
            ([0.0, 1.0], [0.95, 1.0]),
        ] {
            assert_eq!(inked(x, y), 0, "ink in the margin {x:?} {y:?}");
        }
        // Text covers about a tenth of the paper, evenly from top to bottom.
        for part in 0..8 {
            let y = [0.07 + 0.108 * part as f32, 0.07 + 0.108 * (part + 1) as f32];
            let share = inked([0.0, 1.0], y) as f32 / (wide as f32 * 0.108 * high as f32);
            assert!((0.02..0.35).contains(&share), "{share} of part {part} is ink");
        }
    }

    #[test]
    fn every_character_of_the_receipt_is_in_the_fonts() {
        for font in [
            &include_bytes!("../../fonts/JetBrainsMono-Medium.ttf")[..],
            &include_bytes!("../../fonts/JetBrainsMono-ExtraBold.ttf")[..],
        ] {
            let font = FontRef::try_from_slice(font).unwrap();
            for line in receipt_text::lines() {
                let text = match line {
                    Line::Centred(text, _) => text,
                    Line::Spread(a, b, _) => a + &b,
                    Line::Rule | Line::Gap | Line::Bars(_) => continue,
                };
                for character in text.chars() {
                    assert_ne!(font.glyph_id(character).0, 0, "no {character:?}");
                }
            }
        }
    }
}
