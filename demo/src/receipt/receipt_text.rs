//! What the receipt says: a shop, what was bought there, and what it came to. Money is counted in cents.

/// Columns of the print.
pub const WIDTH: usize = 34;

/// An item of the receipt.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Item {
    /// What it is.
    pub name: &'static str,
    /// How many.
    pub quantity: u32,
    /// What one costs, in cents.
    pub price: u32,
}

const fn item(name: &'static str, quantity: u32, price: u32) -> Item {
    Item { name, quantity, price }
}

/// What was bought.
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

/// The tax, in hundredths of a percent of what is bought.
pub const TAX_RATE: u32 = 825;

/// What it comes to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sums {
    /// All items, in cents.
    pub subtotal: u32,
    /// The tax on them, rounded to the nearest cent.
    pub tax: u32,
    /// Both.
    pub total: u32,
}

/// Adds the items up.
pub fn sums() -> Sums {
    let subtotal = ITEMS.iter().map(Item::cost).sum();
    let tax = (subtotal * TAX_RATE + 5000) / 10_000;
    Sums { subtotal, tax, total: subtotal + tax }
}

impl Item {
    /// What all of it costs, in cents.
    pub fn cost(&self) -> u32 {
        self.quantity * self.price
    }
}

/// How a line is set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Face {
    /// Plain.
    Plain,
    /// Heavy.
    Heavy,
    /// Heavy and large, spaced out.
    Title,
}

/// A line of the receipt.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Line {
    /// Text in one of the faces, as wide as it is, in the middle.
    Centred(String, Face),
    /// Text on the left and on the right.
    Spread(String, String, Face),
    /// A row of dashes.
    Rule,
    /// Half a line of nothing.
    Gap,
    /// A code of bars for this number.
    Bars(u64),
}

/// The receipt, line by line.
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

/// Cents as people write them.
fn money(cents: u32) -> String {
    format!("{}.{:02}", cents / 100, cents % 100)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The cents of a text that ends in a sum of money.
    fn cents(text: &str) -> u32 {
        let digits: String = text.chars().filter(char::is_ascii_digit).collect();
        digits.parse().unwrap()
    }

    #[test]
    fn what_is_printed_adds_up_to_the_cent() {
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
    fn everything_that_a_receipt_has_is_there_and_fits() {
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
    fn money_has_two_digits_after_the_point() {
        assert_eq!([5, 100, 12_345].map(money), ["0.05", "1.00", "123.45"]);
    }
}
