//! The command line.

use std::path::PathBuf;

/// How to call it.
pub const USAGE: &str = "usage: cargo bench --bench pipeline -- [options]

  --tables LIST   of pairs, growth, threads, refit, sharing, batch; default all but batch, which needs the program
                  bespoke; separated by commas
  --only TEXT     pairs, refits and grown garments whose name, such as \"jumpsuit_dense Goblin\", has this in it
  --runs N        runs of each case, of which the median counts; default 3, and 1 beyond 10,000 vertices
  --threads N     threads of a session; default 2
  --tight         every pair once more, down to a tolerance of 1e-6, to compare the objectives
  --out FILE      JSON; default build/bench.json";

/// What is asked for.
#[derive(Clone, Debug)]
pub struct Arguments {
    pub tables: Vec<String>,
    pub only: String,
    pub runs: usize,
    pub threads: u32,
    pub tight: bool,
    pub out: PathBuf,
    /// Folders of garment and avatar: measure this one case, in this process.
    pub case: Option<[PathBuf; 2]>,
    /// Another tolerance than the default.
    pub tolerance: Option<f64>,
}

impl Arguments {
    /// Reads them.
    pub fn read(mut words: impl Iterator<Item = String>) -> Result<Self, String> {
        let mut read = Self {
            tables: ["pairs", "growth", "threads", "refit", "sharing"].map(String::from).to_vec(),
            only: String::new(),
            runs: 3,
            threads: 2,
            tight: false,
            out: PathBuf::from("build/bench.json"),
            case: None,
            tolerance: None,
        };
        while let Some(name) = words.next() {
            let mut value = || words.next().ok_or_else(|| format!("{name} needs a value"));
            match name.as_str() {
                // cargo says so.
                "--bench" => {}
                "--tight" => read.tight = true,
                "--tables" => {
                    let mut known = std::mem::take(&mut read.tables);
                    known.push("batch".into());
                    read.tables = value()?.split(',').map(String::from).collect();
                    if let Some(other) = read.tables.iter().find(|table| !known.contains(table)) {
                        return Err(format!("{other} is no table"));
                    }
                }
                "--only" => read.only = value()?,
                "--runs" => read.runs = number(&name, &value()?)?,
                "--threads" => read.threads = number(&name, &value()?)?,
                "--out" => read.out = value()?.into(),
                "--case" => read.case = Some([value()?.into(), value()?.into()]),
                "--tolerance" => read.tolerance = Some(number(&name, &value()?)?),
                _ => return Err(format!("{name} is no option")),
            }
        }
        Ok(read)
    }

    /// Whether a table is asked for.
    pub fn has(&self, table: &str) -> bool {
        self.tables.iter().any(|t| t == table)
    }
}

fn number<T: std::str::FromStr>(name: &str, text: &str) -> Result<T, String> {
    text.parse().map_err(|_| format!("{name} {text}: that is no number"))
}
