//! Ctrl-C in a console: the program says so, ends with 130 and leaves nothing.

use std::fs;
use std::io::{Read, Write};
use std::process::Stdio;

use crate::wine::wine;
use testing::process::{is_there, scratch};
use testing::sample;

/// What is seen on the terminal, without what moves the cursor and without blanks, which Wine skips.
fn seen(bytes: &[u8]) -> String {
    let text = String::from_utf8_lossy(bytes);
    let mut parts = text.split('\u{1b}');
    let mut seen = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let end = part.find(|c: char| c.is_ascii_alphabetic()).map_or(part.len(), |at| at + 1);
        seen.push_str(&part[end..]);
    }
    seen.retain(|c| !c.is_whitespace());
    seen
}

#[test]
fn ctrl_c_stops_and_leaves_nothing() {
    let Some(wine) = wine() else { return };
    // It belongs to util-linux, and gives the program a terminal.
    if !is_there("script") {
        return;
    }
    let place = scratch("windows-stop");
    let words: Vec<String> = sample::words(&place).iter().map(|word| format!("'{word}'")).collect();
    let before = fs::read_dir(&place).expect("the folder").count();
    let program = wine.bin.join("retarget.exe");
    // Where the terminal takes the key itself, the shell is interrupted like the program: it shall live to tell the code.
    let run = format!("wine '{}' {} --threads 1 -o out.obj", program.display(), words.join(" "));
    let line = format!("trap : INT; {run}; echo $? >code");
    let mut command = wine.around("script");
    command.args(["-qec", &line, "/dev/null"]).current_dir(&place);
    let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().expect("script runs");
    let (mut keys, mut screen) = (child.stdin.take().expect("its keys"), child.stdout.take().expect("its screen"));
    let (mut bytes, mut part, mut is_pressed) = (Vec::new(), [0; 4096], false);
    loop {
        let count = screen.read(&mut part).unwrap_or(0);
        if count == 0 {
            break;
        }
        bytes.extend_from_slice(&part[..count]);
        let seen = seen(&bytes);
        if !is_pressed && seen.contains("inflate") {
            keys.write_all(b"\x03").expect("a key can be pressed");
            is_pressed = true;
        }
    }
    drop(keys);
    child.wait().expect("script ends");
    let seen = seen(&bytes);
    assert!(is_pressed, "the console shows no progress: {seen}");
    assert!(seen.contains("stoppedbyCtrl-C"), "{seen}");
    // Not from the screen, of which the last lines may be lost when the terminal closes.
    let code = fs::read_to_string(place.join("code")).expect("the shell lives to write the code");
    assert_eq!(code.trim(), "130", "{seen}");
    let left = fs::read_dir(&place).expect("the folder").count();
    assert_eq!(left, before + 1, "something but the code is left in {}", place.display());
}
