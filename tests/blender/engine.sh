#!/bin/sh
# Fetches the Blender that Debian's unstable suite ships, with what draws its window without a graphics card: engine.sh FOLDER
#
# Left is FOLDER/blender, a script that starts it, also on older systems, with what was unpacked as its system. What lies in the
# folder already stays.
set -eu
unstable=$(cd "$(dirname "$0")/../../.ci" && pwd)/unstable
mkdir -p "$1"
cd "$1"
if [ -f .complete ]; then
    exit
fi
# Blender's Python asks for these four, which its package only recommends.
sh "$unstable" . '^$' blender python3-numpy python3-cattr python3-requests python3-zstandard \
    libgl1 libglx-mesa0 libegl1 libgl1-mesa-dri
cat >blender.new <<EOF
#!/bin/sh
exec sh "$PWD/enter" /usr/bin/blender "\$@"
EOF
chmod +x blender.new
mv blender.new blender
timeout 120 ./blender --background --version >.version
mv .version .complete
