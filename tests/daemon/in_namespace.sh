#!/bin/sh
# Runs a command in a network namespace of its own, which has only a loopback that carries multicast. Messages neither
# leave the machine nor reach other tests. Exit code 77: the system does not allow such namespaces.
set -eu
prepare='ip link set lo up multicast on && ip route add 224.0.0.0/4 dev lo'
for flags in -n -rn; do
  if unshare "$flags" sh -c "$prepare" 2>/dev/null; then
    exec unshare "$flags" sh -c "$prepare"' && exec "$@"' sh "$@"
  fi
done
echo "SKIPPED: no network namespaces are allowed here (unshare --net)" >&2
exit 77
