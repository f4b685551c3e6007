#!/bin/sh
# Builds the book in build/docs: build.sh, with mkdocs, doxygen and cargo. A warning of any of them is an error.
#
# The texts are put together in build/book as they lie in the repository, so that links between them hold. Beside them lie the
# reference of the C header and that of the Rust modules.
set -eu
cd "$(dirname "$0")/../.."
book=build/book
rm -rf "$book" build/docs
mkdir -p "$book/docs" "$book/c"

cp ./*.md "$book"
find docs -maxdepth 1 -type f -exec cp {} "$book/docs" \;
for text in bindings/*/README.md; do
    mkdir -p "$book/$(dirname "$text")"
    cp "$text" "$book/$text"
done
cat >"$book/reference.md" <<'END'
# Reference

- [The C API](c/bespoke_8h.html), made from `include/bespoke.h`
- [The Rust modules](rust/bespoke/index.html), for those who change the library; they may change at any time
END

doxygen packaging/book/Doxyfile
RUSTDOCFLAGS='-D warnings' ${CARGO:-cargo} doc --release --no-deps --package bespoke --lib
cp -R "${CARGO_TARGET_DIR:-target}/doc" "$book/rust"
mkdocs build --quiet --strict --config-file packaging/book/mkdocs.yml

# Links may lead anywhere; what a page needs to be shown may not.
if grep -rnoE '(src|<link[^>]* href)="?https?:[^ ">]*|url\("?https?:[^)]*|@import "?https?:[^;]*' \
    --include='*.html' --include='*.css' build/docs; then
    echo "docs: these are fetched from elsewhere" >&2
    exit 1
fi
echo "docs: build/docs/index.html"
