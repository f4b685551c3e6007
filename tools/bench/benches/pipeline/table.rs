//! Tables of text that are Markdown as well.

/// Prints a table, where it has rows: the first `words` columns to the left, numbers to the right.
pub fn print(title: &str, words: usize, head: &[&str], rows: &[Vec<String>]) {
    if rows.is_empty() {
        return;
    }
    let head: Vec<String> = head.iter().map(|&cell| cell.into()).collect();
    let width = |column: usize| {
        let cells = rows.iter().filter_map(|row| row.get(column)).chain(&head[column..=column]);
        cells.map(|cell| cell.chars().count()).max().unwrap_or(0).max(3)
    };
    let widths: Vec<usize> = (0..head.len()).map(width).collect();
    let line = |row: &[String]| {
        let cell = |(column, (text, &width)): (usize, (&String, &usize))| {
            if column < words { format!("{text:<width$}") } else { format!("{text:>width$}") }
        };
        let cells: Vec<String> = row.iter().zip(&widths).enumerate().map(cell).collect();
        format!("| {} |", cells.join(" | "))
    };
    println!("\n{title}\n\n{}", line(&head));
    let rule = |(column, &width): (usize, &usize)| {
        let dashes = "-".repeat(width - usize::from(column >= words));
        if column < words { dashes } else { dashes + ":" }
    };
    println!("| {} |", widths.iter().enumerate().map(rule).collect::<Vec<_>>().join(" | "));
    rows.iter().for_each(|row| println!("{}", line(row)));
}
