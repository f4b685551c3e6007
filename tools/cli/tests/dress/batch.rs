//! Every outfit on every avatar: results of single calls, none twice, and on from where it was stopped.

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use bespoke_cli::batch::journal::Line;
use bespoke_cli::batch::manifest::{Manifest, Pair};
use bespoke_cli::batch::queue::{AtHand, Queue};

use super::files::folder;
use super::{AVATAR, OUTFIT, bespoke, ends};

pub fn lines(report: &Path) -> Vec<Line> {
    fs::read_to_string(report).unwrap().lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

fn manifest(folder: &Path, text: &str) {
    fs::write(folder.join("all.json"), text).unwrap();
}

#[test]
fn batch() {
    let folder = folder("batch");
    fs::write(folder.join("outfit.glb"), &*OUTFIT).unwrap();
    fs::write(folder.join("slim.glb"), &*AVATAR).unwrap();
    fs::write(folder.join("broken.glb"), b"no character").unwrap();
    manifest(
        &folder,
        r#"{
            "outfits": [{ "file": "outfit.glb", "name": "vest" }],
            "avatars": ["broken.glb", "slim.glb"],
            "output": "results/{outfit}-on-{avatar}.glb",
            "options": { "fit": 3, "keep": "outfit" }
        }"#,
    );
    let report = folder.join("all.report.jsonl");
    let result = folder.join("results/vest-on-slim.glb");
    let run = bespoke(&folder, &["batch", "all.json"]);
    // A failure does not stop it, and is what it ends with.
    ends(&run, 1);
    let mut first = lines(&report);
    first.sort_by(|a, b| a.pair.cmp(&b.pair));
    assert_eq!([&first[0].pair, &first[1].pair], ["vest on broken", "vest on slim"]);
    assert!(first[0].exit == 1 && first[0].output.is_none() && first[0].said.contains("broken.glb"), "{:?}", first[0]);
    assert_eq!((first[1].exit, first[1].output.as_deref()), (0, Some(Path::new("results/vest-on-slim.glb"))));

    // The same bytes as by itself.
    let alone = ["dress", "outfit.glb", "slim.glb", "-o", "alone.glb", "--fit", "3", "--keep", "outfit", "-q"];
    ends(&bespoke(&folder, &alone), 0);
    let bytes = fs::read(&result).unwrap();
    assert!(fs::read(folder.join("alone.glb")).unwrap() == bytes, "the result differs from that of a single call");

    // Nothing is done twice.
    ends(&bespoke(&folder, &["batch", "all.json"]), 1);
    assert_eq!(lines(&report).len(), 2);

    // Stopped as the last line was being written: that pair is done again.
    let text = fs::read_to_string(&report).unwrap();
    let cut: Vec<&str> = text.lines().filter(|line| !line.contains("on slim")).collect();
    let half = serde_json::to_string(&first[1]).unwrap();
    fs::write(&report, format!("{}\n{}", cut[0], &half[..half.len() / 2])).unwrap();
    ends(&bespoke(&folder, &["batch", "all.json", "-q"]), 1);
    let whole: Vec<String> = fs::read_to_string(&report).unwrap().lines().map(String::from).collect();
    assert_eq!(whole.len(), 3);
    assert_eq!(serde_json::from_str::<Line>(&whole[2]).unwrap().pair, "vest on slim");
    assert!(fs::read(&result).unwrap() == bytes);

    // So is one whose result is gone, whose options or whose files have changed, and what had none where that is asked for.
    fs::remove_file(&report).unwrap();
    ends(&bespoke(&folder, &["batch", "all.json"]), 1);
    fs::remove_file(&result).unwrap();
    ends(&bespoke(&folder, &["batch", "all.json"]), 1);
    assert_eq!(lines(&report).len(), 3);
    ends(&bespoke(&folder, &["batch", "all.json", "--retry"]), 1);
    assert_eq!(lines(&report).last().unwrap().pair, "vest on broken");
    fs::write(folder.join("broken.glb"), &*AVATAR).unwrap();
    ends(&bespoke(&folder, &["batch", "all.json"]), 0);
    assert_eq!(lines(&report).len(), 5);
    assert!(fs::read(folder.join("results/vest-on-broken.glb")).unwrap() == bytes);
    ends(&bespoke(&folder, &["batch", "all.json"]), 0);
    assert_eq!(lines(&report).len(), 5);
}

#[test]
fn slices_are_a_partition() {
    let folder = folder("slices");
    manifest(
        &folder,
        r#"{"outfits": ["a.glb", "b.glb"], "avatars": ["x.glb", "y.glb", "z.glb"], "output": "{avatar}/{outfit}.glb"}"#,
    );
    let pairs = Manifest::read(&folder.join("all.json")).unwrap().pairs().unwrap();
    assert_eq!(pairs.iter().map(|pair| pair.name.as_str()).collect::<Vec<_>>()[..2], ["a on x", "a on y"]);
    let mut done = Vec::new();
    for part in 1..=4 {
        // None of the files is there, which is told of each pair.
        let slice = format!("{part}/4");
        ends(&bespoke(&folder, &["batch", "all.json", "--slice", &slice, "-q"]), 1);
        done.extend(lines(&folder.join(format!("all.report.{part}of4.jsonl"))).into_iter().map(|line| line.pair));
    }
    let mut all: Vec<String> = pairs.into_iter().map(|pair| pair.name).collect();
    all.sort();
    done.sort();
    assert_eq!(done, all);
}

#[test]
fn a_manifest_that_says_nothing_known_is_refused() {
    let folder = folder("manifests");
    let lists = r#""outfits": ["a.glb"], "avatars": ["b.glb"]"#;
    for (text, said) in [
        ("[]".to_string(), "object"),
        ("{".into(), "JSON"),
        (r#"{"outfits": [], "avatars": ["b.glb"], "output": "{outfit}{avatar}"}"#.into(), "outfits is empty"),
        (r#"{"avatars": ["b.glb"], "output": "{outfit}{avatar}"}"#.into(), "outfits"),
        (format!(r#"{{{lists}, "output": "out.glb"}}"#), "{outfit}"),
        (format!(r#"{{{lists}, "output": "{{outfit}}{{avatar}}", "speed": 3}}"#), "speed"),
        (format!(r#"{{{lists}, "output": "{{outfit}}{{avatar}}", "options": {{"fits": 3}}}}"#), "fits"),
        (r#"{"outfits": [{"nodes": "A"}], "avatars": ["b.glb"], "output": "{outfit}{avatar}"}"#.into(), "entry 1"),
        (
            r#"{"outfits": ["a.glb", "x/a.glb"], "avatars": ["b.glb"], "output": "{outfit}{avatar}"}"#.into(),
            "another name",
        ),
    ] {
        manifest(&folder, &text);
        let run = bespoke(&folder, &["batch", "all.json"]);
        ends(&run, 2);
        let heard = String::from_utf8_lossy(&run.stderr).into_owned();
        assert!(heard.contains(said), "{text}: {heard}");
    }
    assert!(!folder.join("all.report.jsonl").exists());
}

/// A closet of two small outfits and two avatars, and the bytes that single calls give.
pub fn four_pairs(folder: &Path) -> Vec<(String, Vec<u8>)> {
    for name in ["vest", "waistcoat"] {
        fs::write(folder.join(format!("{name}.glb")), &*OUTFIT).unwrap();
    }
    for name in ["slim", "thin"] {
        fs::write(folder.join(format!("{name}.glb")), &*AVATAR).unwrap();
    }
    manifest(
        folder,
        r#"{
            "outfits": ["vest.glb", { "file": "waistcoat.glb", "nodes": "*Vest" }],
            "avatars": ["slim.glb", "thin.glb"],
            "output": "results/{outfit}-on-{avatar}.glb"
        }"#,
    );
    ends(&bespoke(folder, &["dress", "vest.glb", "slim.glb", "-o", "alone.glb", "-q"]), 0);
    let bytes = fs::read(folder.join("alone.glb")).unwrap();
    let pairs = ["vest", "waistcoat"].into_iter().flat_map(|o| ["slim", "thin"].map(|a| format!("{o}-on-{a}.glb")));
    pairs.map(|name| (name, bytes.clone())).collect()
}

#[track_caller]
pub fn all_there(folder: &Path, expected: &[(String, Vec<u8>)]) {
    for (name, bytes) in expected {
        assert!(fs::read(folder.join("results").join(name)).is_ok_and(|found| found == *bytes), "{name} differs");
    }
}

/// The processes that `process` has started.
#[cfg(target_os = "linux")]
fn children(process: u32) -> Vec<u32> {
    // Each of its threads has its own.
    let threads = fs::read_dir(format!("/proc/{process}/task")).into_iter().flatten().filter_map(|entry| entry.ok());
    let lists = threads.map(|thread| fs::read_to_string(thread.path().join("children")).unwrap_or_default());
    lists.flat_map(|list| list.split_whitespace().map(|id| id.parse().unwrap()).collect::<Vec<_>>()).collect()
}

#[cfg(target_os = "linux")]
fn kill(process: u32) {
    assert!(Command::new("kill").args(["-9", &process.to_string()]).status().unwrap().success());
}

/// A process that dresses is killed: its pair is dressed again, and no other is lost. Then all of them are, with the batch: the next
/// one goes on.
#[cfg(target_os = "linux")]
#[test]
fn what_is_killed_is_done_again_and_nothing_twice() {
    let folder = folder("killed");
    let expected = four_pairs(&folder);
    let batch = || {
        Command::new(env!("CARGO_BIN_EXE_bespoke"))
            .current_dir(&folder)
            .args(["batch", "all.json", "--jobs=1", "-q"])
            .spawn()
            .unwrap()
    };
    let until = |what: &dyn Fn() -> bool| {
        let clock = Instant::now();
        while !what() {
            assert!(clock.elapsed() < Duration::from_secs(300), "nothing happens");
            std::thread::sleep(Duration::from_millis(5));
        }
    };
    let report = folder.join("all.report.jsonl");
    let done = || fs::read_to_string(&report).map_or(0, |text| text.lines().count());
    let mut first = batch();
    until(&|| !children(first.id()).is_empty());
    let worker = children(first.id())[0];
    kill(worker);
    until(&|| done() == 2);
    let last = children(first.id());
    kill(first.id());
    first.wait().unwrap();
    // The one that was at work ends by itself: nobody asks it any more.
    let has_ended =
        |id: &u32| fs::read_to_string(format!("/proc/{id}/stat")).map_or(true, |stat| stat.contains(") Z "));
    until(&|| last.iter().all(has_ended));
    let before = done();
    assert!((2..4).contains(&before), "{before} lines");
    assert!(batch().wait().unwrap().success());
    all_there(&folder, &expected);
    let mut pairs: Vec<String> = lines(&report).into_iter().map(|line| line.pair).collect();
    pairs.sort();
    assert_eq!(pairs, ["vest on slim", "vest on thin", "waistcoat on slim", "waistcoat on thin"]);
}

/// Two batches at one report take turns: the second finds all done.
#[test]
fn two_at_once_do_nothing_twice() {
    let folder = folder("at_once");
    let expected = four_pairs(&folder);
    let batch = || {
        let mut command = Command::new(env!("CARGO_BIN_EXE_bespoke"));
        command.current_dir(&folder).args(["batch", "all.json"]).stderr(Stdio::piped()).spawn().unwrap()
    };
    let both = [batch(), batch()].map(|batch| batch.wait_with_output().unwrap());
    both.iter().for_each(|output| ends(output, 0));
    let said = both.map(|output| String::from_utf8_lossy(&output.stderr).into_owned()).concat();
    assert!(said.contains("4 of 4 pairs are done already"), "{said}");
    assert_eq!(lines(&folder.join("all.report.jsonl")).len(), 4);
    all_there(&folder, &expected);
}

/// All pairs of so many outfits and these avatars.
fn grid(name: &str, outfits: usize, avatars: &[&str]) -> Vec<Pair> {
    let folder = folder(name);
    let files = |names: &mut dyn Iterator<Item = String>| {
        names.map(|name| format!("\"{name}.glb\"")).collect::<Vec<_>>().join(", ")
    };
    let outfits = files(&mut (1..=outfits).map(|k| format!("outfit-{k}")));
    let avatars = files(&mut avatars.iter().map(|name| (*name).to_string()));
    let text = format!(r#"{{"outfits": [{outfits}], "avatars": [{avatars}], "output": "{{avatar}}/{{outfit}}.glb"}}"#);
    manifest(&folder, &text);
    Manifest::read(&folder.join("all.json")).unwrap().pairs().unwrap()
}

/// Lets so many processes dress `pairs`, each of which takes `seconds`: the tasks of each process with their threads, and when all
/// are done.
fn simulated(pairs: &[Pair], jobs: usize, seconds: impl Fn(&Pair) -> f64) -> (Vec<Vec<(&Pair, usize)>>, f64) {
    let queue = Queue::new(&pairs.iter().collect::<Vec<_>>(), jobs);
    let mut hands: Vec<AtHand> = (0..jobs).map(|_| AtHand::default()).collect();
    let mut tasks = vec![Vec::new(); jobs];
    // When each is free, and after which pair.
    let mut free: Vec<(f64, Option<&Pair>)> = vec![(0.0, None); jobs];
    let mut end = 0.0f64;
    while let Some(who) =
        (0..free.len()).filter(|&k| free[k].0.is_finite()).min_by(|&a, &b| free[a].0.total_cmp(&free[b].0))
    {
        let (now, last) = free[who];
        end = end.max(now);
        last.into_iter().for_each(|pair| queue.ended(pair, seconds(pair)));
        free[who] = match queue.next(&mut hands[who]) {
            Some(task) => {
                tasks[who].push((task.pair, task.threads));
                (now + seconds(task.pair), Some(task.pair))
            }
            None => (f64::INFINITY, None),
        };
    }
    (tasks, end)
}

#[test]
fn what_takes_long_is_not_left_to_the_end() {
    let pairs = grid("queue", 3, &["x", "y", "long"]);
    let (tasks, end) = simulated(&pairs, 2, |pair| if pair.avatar.contains("long") { 5.0 } else { 1.0 });
    let all: Vec<&str> = tasks.iter().flatten().map(|(pair, _)| pair.name.as_str()).collect();
    let mut names: Vec<&str> = pairs.iter().map(|pair| pair.name.as_str()).collect();
    let mut sorted = all.clone();
    sorted.sort_unstable();
    names.sort_unstable();
    assert_eq!(sorted, names);
    // 21 s for two; avatar after avatar it takes 13.
    assert!(end <= 11.0, "{end}: {all:?}");
    // The last one has both cores.
    let threads: Vec<usize> = tasks.iter().flatten().map(|(_, threads)| *threads).collect();
    assert_eq!(threads.iter().filter(|&&threads| threads == 2).count(), 1, "{threads:?}");
    assert!(tasks.iter().any(|own| own.last().unwrap().1 == 2));
}

#[test]
fn avatars_are_prepared_once_for_as_many_outfits_as_are_kept_in_mind() {
    let pairs = grid("queue-outfits", 20, &["x", "y", "z"]);
    let (tasks, _) = simulated(&pairs, 1, |_| 1.0);
    let (mut kept, mut read, mut prepared) = (Vec::new(), 0, 0);
    let mut last = "";
    for (pair, threads) in &tasks[0] {
        assert_eq!(*threads, 1);
        prepared += usize::from(pair.avatar != last);
        last = &pair.avatar;
        if !kept.contains(&pair.outfit) {
            read += 1;
            kept.insert(0, pair.outfit.clone());
            kept.truncate(8);
        }
    }
    assert_eq!((tasks[0].len(), read), (60, 20));
    // Three times for 8, 8 and 4 outfits, but for those at which it is already.
    assert_eq!(prepared, 7);
}
