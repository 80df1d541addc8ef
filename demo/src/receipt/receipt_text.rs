//! Text of the receipt: shop, items, tax and total.
//!
//! Method: amounts are integers in cents; the lines are formatted for a monospaced font.
//!
//! Reads [`ITEMS`]; returns [`Line`]s.
//!
//! Invariant: the printed amounts add up to the cent, and no line is wider than [`WIDTH`].

/// Characters per line.
pub const WIDTH: usize = 34;

/// An item on the receipt.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Item {
    /// Name.
    pub name: &'static str,
    /// Quantity.
    pub quantity: u32,
    /// Price of one, in cents.
    pub price: u32,
}

const fn item(name: &'static str, quantity: u32, price: u32) -> Item {
    Item { name, quantity, price }
}

/// Items on the receipt.
pub const ITEMS: [Item; 9] = [
    item("Muslin, unbleached, 1 m", 3, 745),
    item("Silk thread, 100 m", 2, 390),
    item("Tailor's chalk, white", 1, 225),
    item("Paper pattern, size M", 1, 1150),
    item("Glass-head pins, box", 1, 480),
    item("Linen tape, 10 mm", 4, 95),
    item("Bone folder", 1, 690),
    item("Shears, 8 in", 1, 2800),
    item("Filter coffee", 2, 260),
];

/// Tax rate, in hundredths of a percent of the subtotal.
pub const TAX_RATE: u32 = 825;

/// Sums of the receipt.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sums {
    /// Sum of all items, in cents.
    pub subtotal: u32,
    /// Tax, rounded to the nearest cent.
    pub tax: u32,
    /// Subtotal and tax.
    pub total: u32,
}

/// Adds up the items.
pub fn sums() -> Sums {
    let subtotal = ITEMS.iter().map(Item::cost).sum();
    let tax = (subtotal * TAX_RATE + 5000) / 10_000;
    Sums { subtotal, tax, total: subtotal + tax }
}

impl Item {
    /// Returns quantity times price, in cents.
    pub fn cost(&self) -> u32 {
        self.quantity * self.price
    }
}

/// Typeface of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Face {
    /// Plain text.
    Plain,
    /// Bold text.
    Heavy,
    /// Bold, large text with wide letter spacing.
    Title,
}

/// A line of the receipt.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Line {
    /// Centred text.
    Centred(String, Face),
    /// Text at the left margin and at the right margin.
    Spread(String, String, Face),
    /// A dashed line.
    Rule,
    /// Half an empty line.
    Gap,
    /// A bar code of this number.
    Bars(u64),
}

/// Returns all lines of the receipt.
pub fn lines() -> Vec<Line> {
    let centred = |text: &str| Line::Centred(text.into(), Face::Plain);
    let spread = |left: &str, right: &str| Line::Spread(left.into(), right.into(), Face::Plain);
    let sums = sums();
    let mut lines = vec![
        Line::Centred("TENDER".into(), Face::Title),
        centred("Cloth & Paper Goods"),
        centred("14 Weaver's Row, Loomfield"),
        centred("Tel. 555-0142"),
        Line::Gap,
        spread("2026-04-21  14:36", "No. 001960"),
        spread("Register 2", "Served by Ada"),
        Line::Rule,
    ];
    for (i, item) in ITEMS.iter().enumerate() {
        let name = format!("{:2}. {}", i + 1, item.name);
        lines.push(Line::Spread(name, money(item.cost()), Face::Plain));
        if item.quantity > 1 {
            let detail = format!("    {} \u{d7} {}", item.quantity, money(item.price));
            lines.push(Line::Spread(detail, String::new(), Face::Plain));
        }
    }
    lines.extend([
        Line::Rule,
        spread("Subtotal", &money(sums.subtotal)),
        spread(&format!("Tax {}.{:02}%", TAX_RATE / 100, TAX_RATE % 100), &money(sums.tax)),
        Line::Gap,
        Line::Spread("TOTAL".into(), format!("${}", money(sums.total)), Face::Heavy),
        Line::Rule,
        spread(
            "Card \u{b7}\u{b7}\u{b7}\u{b7} \u{b7}\u{b7}\u{b7}\u{b7} \u{b7}\u{b7}\u{b7}\u{b7} 1920",
            &money(sums.total),
        ),
        spread("Approved", "Auth 960120"),
        Line::Gap,
        Line::Bars(20_260_421_001_960),
        centred("THANK YOU, FOLD AGAIN SOON"),
    ]);
    lines
}

/// Formats cents as an amount.
fn money(cents: u32) -> String {
    format!("{}.{:02}", cents / 100, cents % 100)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Parses the amount at the end of a text, in cents.
    fn cents(text: &str) -> u32 {
        let digits: String = text.chars().filter(char::is_ascii_digit).collect();
        digits.parse().unwrap()
    }

    #[test]
    fn the_printed_amounts_add_up_to_the_cent() {
        let lines = lines();
        let spread = |wanted: &str| {
            let found = lines.iter().find_map(|line| match line {
                Line::Spread(left, right, _) if left.starts_with(wanted) => Some(cents(right)),
                _ => None,
            });
            found.unwrap_or_else(|| panic!("no line starts with {wanted:?}"))
        };
        let numbered = |i: usize| spread(&format!("{i:2}. "));
        let bought: u32 = (1..=ITEMS.len()).map(numbered).sum();
        assert_eq!(bought, spread("Subtotal"));
        let exact = f64::from(bought) * f64::from(TAX_RATE) / 1.0e4;
        assert!((f64::from(spread("Tax")) - exact).abs() <= 0.5, "{exact}");
        assert_eq!(spread("Subtotal") + spread("Tax"), spread("TOTAL"));
        assert_eq!(spread("Card"), spread("TOTAL"));
        for item in ITEMS {
            assert_eq!(item.cost(), item.quantity * item.price);
        }
    }

    #[test]
    fn the_receipt_has_all_its_parts_and_they_fit() {
        let lines = lines();
        for line in &lines {
            let long = match line {
                Line::Centred(text, _) => text.chars().count(),
                Line::Spread(left, right, _) => left.chars().count() + right.chars().count() + 1,
                Line::Rule | Line::Gap | Line::Bars(_) => 0,
            };
            assert!(long <= WIDTH, "{line:?} is {long} wide");
        }
        assert!(lines.iter().filter(|line| **line == Line::Rule).count() >= 3);
        let text = format!("{lines:?}");
        for part in
            ["TENDER", "Row", "2026-04-21", "14:36", " 1. ", " \u{d7} ", "Card", "THANK YOU"]
        {
            assert!(text.contains(part), "no {part:?}");
        }
    }

    #[test]
    fn amounts_have_two_decimal_places() {
        assert_eq!([5, 100, 12_345].map(money), ["0.05", "1.00", "123.45"]);
    }
}
