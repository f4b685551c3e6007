//! The character to dress, read and prepared once for all outfits that are put on it one after the other.

use std::path::Path;

use bespoke::input::coordinate_system::CoordinateSystem;
use bespoke::session::SharedAvatar;

use crate::args::{Dress, Keep};
use crate::bodies;
use crate::failure::{Failure, Result};
use crate::figure::{Choice, Figure};
use crate::file_state::FileState;
use crate::fit::shared_avatar;
use crate::obj::Beside;
use crate::parts::Role;
use crate::parts::pattern::Patterns;

/// A character to dress.
pub struct KnownAvatar {
    read_from: Source,
    /// Its file.
    pub figure: Figure,
    /// What of it is dressed.
    pub body: bodies::Avatar,
    /// The same, for all sessions.
    pub shared: SharedAvatar,
    /// Its coordinate system.
    pub space: CoordinateSystem,
}

/// All that it depends on: another size or age of the file, and it is read again.
#[derive(PartialEq, Eq)]
struct Source {
    file: FileState,
    nodes: Option<String>,
    beside: Beside,
    is_clothed: bool,
}

impl Source {
    fn of(args: &Dress) -> Self {
        Self {
            file: FileState::of(&args.avatar),
            nodes: args.avatar_nodes.clone(),
            beside: Beside {
                skeleton: args.obj.target_skeleton.clone(),
                skin: args.obj.target_skin.clone(),
                space: args.obj.target_space.clone(),
            },
            is_clothed: args.keep == Keep::Both,
        }
    }
}

impl KnownAvatar {
    /// The character that `args` are about: the one in `known`, or read anew.
    ///
    /// # Errors
    /// Where it cannot be read or dressed.
    pub fn of<'a>(args: &Dress, known: &'a mut Option<Self>) -> Result<&'a Self> {
        let source = Source::of(args);
        // Taken out, so that nothing is left of it where another one cannot be read.
        if let Some(same) = known.take().filter(|known| known.read_from == source) {
            return Ok(known.insert(same));
        }
        let garments = None;
        let body = args.avatar_nodes.as_deref().map(Patterns::parse).transpose().map_err(Failure::usage)?;
        let figure = Figure::open_with(&args.avatar, Role::Avatar, &Choice { garments, body }, &source.beside)?;
        if figure.obj.is_some() && figure.rig.joints.is_empty() {
            return Err(Failure::no_result(format!(
                "{}: there is no skeleton beside it; name it with --target-skeleton (an OBJ file with a v line for each joint and \
                 an l line for each bone), or put it there as skeleton.obj",
                args.avatar.display()
            )));
        }
        figure.need_rig("it cannot be dressed; give a character with a skeleton and skin weights")?;
        let body = bodies::avatar(&figure, args.keep == Keep::Both);
        let shared = share(&args.avatar, &figure, &body)?;
        let mut space = figure.space();
        // Which way a character faces, no file says for sure.
        space.trusted &= figure.obj.is_some();
        Ok(known.insert(Self { read_from: source, figure, body, shared, space }))
    }
}

/// The body of a character, for all sessions.
///
/// # Errors
/// Where the library refuses it.
pub fn share(file: &Path, figure: &Figure, avatar: &bodies::Avatar) -> Result<SharedAvatar> {
    shared_avatar(&figure.rig, &avatar.body, &avatar.roles)
        .map_err(|error| Failure::no_result(format!("{}: {error}", file.display())))
}
