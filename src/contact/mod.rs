//! Contact between the garment, the avatar and the garment itself.
