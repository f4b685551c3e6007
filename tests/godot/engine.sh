#!/bin/sh
# Fetches the Godot that Debian's unstable suite ships and unpacks it with what it needs: engine.sh FOLDER [pictures]
#
# Left is FOLDER/godot, a script that starts it, also on older systems, by the C library that is unpacked beside it. Nothing
# of the system changes, and root is not needed. With `pictures` it can also draw without a graphics card. What lies in the
# folder already stays.
set -eu
if [ "$(uname -sm)" != 'Linux x86_64' ] || ! command -v apt-get >/dev/null 2>&1; then
    echo "engine: it takes Linux x86_64, and apt-get to fetch Debian's packages with" >&2
    exit 1
fi
keyring=/usr/share/keyrings/debian-archive-keyring.gpg
if [ ! -f "$keyring" ]; then
    echo "engine: $keyring is not there; install debian-archive-keyring" >&2
    exit 1
fi
mkdir -p "$1"
cd "$1"
if [ -f .pictures ] || { [ -f .complete ] && [ "${2-}" != pictures ]; }; then
    exit
fi
rm -f .complete
here=$PWD

# The mirror that this machine uses, if it does. What stands in braces is for apt to fill in.
# shellcheck disable=SC2016
uri=$(apt-get indextargets --format '$(REPO_URI)' 'Origin: Debian' 'Component: main' 'Created-By: Packages' |
    grep -v security | head -n 1)
# Lists and a state of our own, in which no package is installed, so that all that is needed is fetched. Unstable keeps no older
# versions: what it has is taken, and a mirror's list may have expired. Its signature is checked all the same.
mkdir -p apt/lists/partial apt/cache/archives/partial packages
: >apt/status
echo "deb [signed-by=$keyring] ${uri:-http://deb.debian.org/debian} sid main" >apt/sources.list
own_apt() {
    apt-get -qq -o "Dir::Etc::sourcelist=$here/apt/sources.list" -o Dir::Etc::sourceparts=/dev/null \
        -o Dir::Etc::preferencesparts=/dev/null -o "Dir::State=$here/apt" -o "Dir::State::lists=$here/apt/lists" \
        -o "Dir::State::status=$here/apt/status" -o "Dir::Cache=$here/apt/cache" -o Acquire::Check-Valid-Until=false \
        -o Acquire::Languages=none -o APT::Sandbox::User="$(id -un)" "$@"
}
own_apt update

# The driver that draws is a third of it, and a run without a window never loads it.
if [ "${2-}" = pictures ]; then
    drawing="libgl1 libglx-mesa0 libegl1 libgl1-mesa-dri"
    left_out='^$'
else
    drawing=""
    left_out='^(mesa-libgallium|libllvm.*|libz3-4)$'
fi
# The names are words to be split.
# shellcheck disable=SC2086
names=$(own_apt install --print-uris --no-install-recommends godot $drawing |
    sed 's/.* \([^_ ]*\)_[^ ]*\.deb .*/\1/' | grep -Ev "$left_out")
missing=""
for name in $names; do
    ls "packages/${name}_"*.deb >/dev/null 2>&1 || missing="$missing $name"
done
# shellcheck disable=SC2086
[ -z "$missing" ] || (cd packages && own_apt download $missing)
rm -rf root
mkdir root
for package in packages/*.deb; do
    dpkg-deb -x "$package" root
done

# By the loader that is unpacked: that of the system may be older than what Godot was built with.
cat >godot.new <<'END'
#!/bin/sh
root=$(cd "$(dirname "$0")" && pwd)/root
libraries=$root/usr/lib/x86_64-linux-gnu
export LIBGL_DRIVERS_PATH="$libraries/dri" __EGL_VENDOR_LIBRARY_DIRS="$root/usr/share/glvnd/egl_vendor.d"
exec "$root/usr/lib64/ld-linux-x86-64.so.2" --library-path "$libraries:$libraries/pulseaudio" --argv0 godot \
    "$root/usr/bin/godot" "$@"
END
chmod +x godot.new
mv godot.new godot
timeout 60 ./godot --headless --version >.complete
[ "${2-}" != pictures ] || cp .complete .pictures
rm -rf apt
