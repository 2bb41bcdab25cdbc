#!/bin/sh
# Runs a command with a file system of 4 MB in $AZIMUTH_SMALL_DISK. The file system exists only in the command's own
# mount namespace and vanishes with it. Exit code 77: the system does not allow such namespaces.
set -eu
folder=$(mktemp -d)
trap 'rmdir "$folder"' EXIT
if ! unshare -rm mount -t tmpfs -o size=4m azimuth-test "$folder" 2>/dev/null; then
  echo "SKIPPED: no mount namespaces are allowed here (unshare --mount)" >&2
  exit 77
fi
AZIMUTH_SMALL_DISK=$folder unshare -rm sh -c '
  mount -t tmpfs -o size=4m azimuth-test "$AZIMUTH_SMALL_DISK"
  exec "$@"' sh "$@"
