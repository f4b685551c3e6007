//! The command line.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum, ValueHint};
use clap_complete::Shell;

/// Dresses characters in files: takes an outfit that was made for one character and puts it on another, with no triangle
/// through another.
#[derive(Clone, Debug, Parser)]
#[command(name = "bespoke", version, after_help = EXIT_CODES)]
pub struct CommandLine {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

const EXIT_CODES: &str = "Exit: 0 when it is done, 1 when there is no result, 2 for a wrong command line, 3 when `dress` has a \
                          verified result that is not worn as designed or `check` found intersections, 130 for Ctrl-C. \
                          Files appear whole or not at all.";

/// What can be done.
#[derive(Clone, Debug, Subcommand)]
pub enum Command {
    /// Puts the outfit of one file on the character of another.
    Dress(Box<Dress>),
    /// Dresses every outfit of a manifest on every avatar; goes on where it was stopped.
    Batch(Batch),
    /// Dresses the pairs that `bespoke batch` tells on standard input, one after the other.
    #[command(hide = true)]
    BatchWorker,
    /// Says what is in a file: rig, parts, poses, and what will need attention.
    Inspect(Inspect),
    /// Counts intersections of garments and body in a file.
    Check(Check),
    /// Writes completions for a shell to standard output.
    #[command(hide = true)]
    Completions {
        /// Which shell.
        shell: Shell,
    },
    /// Writes the manual page to standard output.
    #[command(hide = true)]
    Man,
}

/// What of the avatar stays in the result, beside the outfit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Keep {
    /// Its body, without the clothes that it wore.
    Body,
    /// Nothing but its skeleton: the outfit alone, to be put on elsewhere.
    Outfit,
    /// All of it: body and clothes, over which the outfit is fitted.
    #[default]
    Both,
}

/// `bespoke dress`.
#[derive(Clone, Debug, Args)]
pub struct Dress {
    /// The file with the outfit: GLB, glTF, VRM or OBJ.
    #[arg(value_hint = ValueHint::FilePath)]
    pub outfit: PathBuf,
    /// The character to dress: GLB, glTF, VRM or OBJ.
    #[arg(value_hint = ValueHint::FilePath)]
    pub avatar: PathBuf,
    /// Where the result goes: .glb, .vrm or .gltf; of an avatar that is an OBJ file, .obj too.
    #[arg(short, long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub output: PathBuf,
    /// The character that the outfit was made for, where it is not in the outfit's file.
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub source: Option<PathBuf>,
    /// What of the avatar stays beside the outfit.
    #[arg(long, value_enum, default_value_t)]
    pub keep: Keep,
    /// The garments in the outfit's file, where their names do not say it: NODE or NODE:MATERIAL between commas, with * for any
    /// text and ! before what is left out. `bespoke inspect` lists them.
    #[arg(long, value_name = "NAMES")]
    pub nodes: Option<String>,
    /// The body in the outfit's or source's file, in the same way.
    #[arg(long, value_name = "NAMES")]
    pub source_nodes: Option<String>,
    /// The body in the avatar's file, in the same way; everything else stays in the file and is passed through.
    #[arg(long, value_name = "NAMES")]
    pub avatar_nodes: Option<String>,
    /// Joints that correspond where the names do not say it: a line for each, the outfit's joint and the avatar's with a tab or
    /// blanks between them, by name or number, or - where there is none.
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub map: Option<PathBuf>,
    /// How tight; 0 switches the fit off.
    #[arg(long, value_name = "W", default_value_t = 2.0)]
    pub fit: f64,
    /// Clearance to aim at everywhere, beside the designed one, in the avatar's unit.
    #[arg(long, value_name = "D", default_value_t = 0.0)]
    pub offset: f64,
    /// How much of the looseness that it had on its own body to aim at; 0 is tight.
    #[arg(long, value_name = "X", default_value_t = 1.0)]
    pub looseness: f64,
    /// Joints for each vertex of the result: what the engine takes.
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u32).range(1..=8))]
    pub influences: u32,
    /// What lies beside OBJ files.
    #[command(flatten)]
    pub obj: ObjFiles,
    /// Threads; 0 takes all cores.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub threads: u32,
    /// Writes a report of all garments, findings and the joint map as JSON; - is standard output.
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub json: Option<PathBuf>,
    /// No progress and no findings, errors alone.
    #[arg(short, long)]
    pub quiet: bool,
}

/// What OBJ files do not hold. Of x.obj, x.skeleton.obj or skeleton.obj beside it is its skeleton, and x.skin.txt its skin weights, of
/// an avatar skin.txt too, where they are not named here.
#[derive(Clone, Debug, Default, PartialEq, Eq, Args)]
#[command(next_help_heading = "OBJ files (skeleton.obj and skin.txt beside them are found)")]
pub struct ObjFiles {
    /// The skeleton that the outfit was made on: OBJ with a v line for each joint and an l line for each bone, or a rig: a line
    /// 'joint NAME PARENT' and the 16 numbers of the bind transform for each joint.
    #[arg(long, visible_alias = "source-rig", value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub source_skeleton: Option<PathBuf>,
    /// The avatar's skeleton or rig. Two skeletons of the same joints and bones correspond joint by joint.
    #[arg(long, visible_alias = "target-rig", value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub target_skeleton: Option<PathBuf>,
    /// Skin weights of the avatar: a row for each joint with a number for each vertex, or a line 'JOINT WEIGHT JOINT WEIGHT ...'
    /// for each vertex, joints from 0.
    #[arg(long, visible_alias = "skin-weights", value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub target_skin: Option<PathBuf>,
    /// The same of the character that --source names.
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub source_skin: Option<PathBuf>,
    /// The same of the outfit.
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub garment_skin: Option<PathBuf>,
    /// Axes of outfit and source that point right, up and forward, and metres a unit where that is not 1: x,z,y for Blender's,
    /// y,z,x,0.01 for Unreal's (x,y,-z). With ',trusted' at its end nothing is turned or refused for axes and unit.
    #[arg(long, value_name = "AXES", allow_hyphen_values = true)]
    pub source_space: Option<String>,
    /// The same of the avatar.
    #[arg(long, value_name = "AXES", allow_hyphen_values = true)]
    pub target_space: Option<String>,
}

/// `bespoke batch`.
#[derive(Clone, Debug, Args)]
pub struct Batch {
    /// What to dress: JSON with the lists "outfits" and "avatars", "output" with {outfit} and {avatar} in it, and "options".
    #[arg(value_hint = ValueHint::FilePath)]
    pub manifest: PathBuf,
    /// A line of JSON for each pair that has ended. What stands in it is not done again, unless its files or options have
    /// changed. By default beside the manifest, one for each slice.
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub report: Option<PathBuf>,
    /// Pairs at a time, each with one thread; 0 takes all cores.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub jobs: u32,
    /// The I-th of N parts of the pairs, for several machines.
    #[arg(long, value_name = "I/N", default_value = "1/1", value_parser = slice)]
    pub slice: (u32, u32),
    /// Tries those again that had no result.
    #[arg(long)]
    pub retry: bool,
    /// No line for each pair.
    #[arg(short, long)]
    pub quiet: bool,
}

fn slice(text: &str) -> Result<(u32, u32), String> {
    let numbers = text.split_once('/').and_then(|(part, parts)| Some((part.parse().ok()?, parts.parse().ok()?)));
    match numbers {
        Some((part, parts)) if part >= 1 && part <= parts => Ok((part, parts)),
        _ => Err("a slice is such as 2/8: the second of eight parts".into()),
    }
}

/// `bespoke inspect`.
#[derive(Clone, Debug, Args)]
pub struct Inspect {
    /// The file: GLB, glTF, VRM or OBJ.
    #[arg(value_hint = ValueHint::FilePath)]
    pub file: PathBuf,
    /// Another character: which of its joints correspond to those of the first.
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath)]
    pub against: Option<PathBuf>,
    /// As JSON, for programs.
    #[arg(long)]
    pub json: bool,
}

/// `bespoke check`.
#[derive(Clone, Debug, Args)]
pub struct Check {
    /// The file: GLB, glTF, VRM or OBJ.
    #[arg(value_hint = ValueHint::FilePath)]
    pub file: PathBuf,
    /// The garments, as for `dress`, where neither their names say it nor `dress` has put them on.
    #[arg(long, value_name = "NAMES")]
    pub nodes: Option<String>,
    /// Moments of an animation too, by its name or number; without a NAME of all animations of the file.
    #[arg(long, value_name = "NAME", num_args = 0..=1)]
    #[allow(clippy::option_option, reason = "clap's way to say that the value may be missing")]
    pub animation: Option<Option<String>>,
    /// How many moments of each animation: all of its keys where it has no more, else evenly between first and last key.
    #[arg(long, value_name = "N", default_value_t = 6, requires = "animation", value_parser = clap::value_parser!(u32).range(1..))]
    pub moments: u32,
    /// As JSON, for programs.
    #[arg(long)]
    pub json: bool,
}
