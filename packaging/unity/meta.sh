#!/bin/sh
# Writes the .meta file of every path that the engine sees as an asset: meta.sh FOLDER NAME
#
# Below folders that end in ~ it sees none. The GUID is a hash of NAME and the path within FOLDER: it stays when the package is made
# again, so that what refers to a script or a library still does.
set -eu
export LC_ALL=C
name=$2
cd "$1"

plugin() {
    # OS, extension of the exclude flags: the others are excluded.
    linux=1 windows=1
    case $1 in Linux) linux=0 ;; Windows) windows=0 ;; esac
    cat <<EOF
PluginImporter:
  externalObjects: {}
  serializedVersion: 2
  iconMap: {}
  executionOrder: {}
  defineConstraints: []
  isPreloaded: 0
  isOverridable: 1
  isExplicitlyReferenced: 0
  validateReferences: 1
  platformData:
  - first:
      : Any
    second:
      enabled: 0
      settings:
        Exclude Editor: 0
        Exclude Linux64: $linux
        Exclude OSXUniversal: 1
        Exclude Win: 1
        Exclude Win64: $windows
  - first:
      Any: 
    second:
      enabled: 0
      settings: {}
  - first:
      Editor: Editor
    second:
      enabled: 1
      settings:
        CPU: x86_64
        DefaultValueInitialized: true
        OS: $1
  - first:
      Standalone: Linux64
    second:
      enabled: $((1 - linux))
      settings:
        CPU: x86_64
  - first:
      Standalone: Win64
    second:
      enabled: $((1 - windows))
      settings:
        CPU: x86_64
EOF
}

importer() {
    case $1 in
        *.cs)
            echo "MonoImporter:
  externalObjects: {}
  serializedVersion: 2
  defaultReferences: []
  executionOrder: 0
  icon: {instanceID: 0}"
            ;;
        *.asmdef) echo "AssemblyDefinitionImporter:
  externalObjects: {}" ;;
        ./package.json) echo "PackageManifestImporter:
  externalObjects: {}" ;;
        *.md | *.txt | *.json) echo "TextScriptImporter:
  externalObjects: {}" ;;
        *.so) plugin Linux ;;
        *.dll) plugin Windows ;;
        *) echo "DefaultImporter:
  externalObjects: {}" ;;
    esac
    echo "  userData: 
  assetBundleName: 
  assetBundleVariant: "
}

find . -mindepth 1 -name '*~' -prune -o -name '*.meta' -o -mindepth 1 -print | while read -r path; do
    {
        echo "fileFormatVersion: 2"
        echo "guid: $(printf '%s/%s' "$name" "${path#./}" | md5sum | cut -c 1-32)"
        [ ! -d "$path" ] || echo "folderAsset: yes"
        importer "$path"
    } >"$path.meta"
done
