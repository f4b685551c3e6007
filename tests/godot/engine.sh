#!/bin/sh
# Fetches the Godot that Debian's unstable suite ships and unpacks it with what it needs: engine.sh FOLDER [pictures]
#
# Left is FOLDER/godot, a script that starts it, also on older systems, by the C library that is unpacked beside it; and
# FOLDER/root/usr/bin/godot-template-release, of which exported games are made. With `pictures` it can also draw without a graphics
# card. What lies in the folder already stays.
set -eu
unstable=$(cd "$(dirname "$0")/../../.ci" && pwd)/unstable
mkdir -p "$1"
cd "$1"
if [ -x enter ] && { [ -f .pictures ] || { [ -f .complete ] && [ "${2-}" != pictures ]; }; }; then
    exit
fi
rm -f .complete
# The driver that draws is a third of it, and a run without a window never loads it.
if [ "${2-}" = pictures ]; then
    sh "$unstable" . '^$' godot godot-template-release libgl1 libglx-mesa0 libegl1 libgl1-mesa-dri
else
    sh "$unstable" . '^(mesa-libgallium|libllvm.*|libz3-4)$' godot godot-template-release
fi

# By the loader that is unpacked: that of the system may be older than what Godot was built with.
cat >godot.new <<'EOF'
#!/bin/sh
root=$(cd "$(dirname "$0")" && pwd)/root
libraries=$root/usr/lib/x86_64-linux-gnu
export LIBGL_DRIVERS_PATH="$libraries/dri" __EGL_VENDOR_LIBRARY_DIRS="$root/usr/share/glvnd/egl_vendor.d"
exec "$root/usr/lib64/ld-linux-x86-64.so.2" --library-path "$libraries:$libraries/pulseaudio" --argv0 godot \
    "$root/usr/bin/godot" "$@"
EOF
chmod +x godot.new
mv godot.new godot
timeout 60 ./godot --headless --version >.complete
[ "${2-}" != pictures ] || cp .complete .pictures
