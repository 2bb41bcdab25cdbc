#!/bin/sh
# Submits a job of the workflow to Slurm and prints its number. Jobs of a killed workflow continue to run. If such a job
# has the same settings, it is used again, also if it has ended; if it has other settings, the new job starts after its
# end, because both write the same file.
#
# usage: submit.sh OUTPUT CPUS MEMORY_MB MINUTES JOBSCRIPT
set -eu
output=$1 cpus=$2 memory_mb=$3 minutes=$4 jobscript=$5
digest() { sha256sum | cut -c 1-16; }

name=fleet-$(echo "$PWD/$output" | digest)
settings=$(sed -n 's/"jobid": [0-9]*//; s/^# properties = //p' "$jobscript" | digest)
queued=$(squeue --me --noheader --states=PENDING,RUNNING --name="$name" --format='%i %k' |
  awk -v settings="$settings" '$2 == settings { print $1; exit }')
if [ -n "$queued" ]; then
  echo "$queued"
  exit
fi
# A job that has left the queue has stored a copy of its output until status.sh has reported its end, because Snakemake
# removes output that it does not know to be complete.
kept=.snakemake/slurm/done/$name
if [ "$(cat "$kept.settings" 2>/dev/null)" = "$settings" ]; then
  mkdir -p "$(dirname "$output")"
  cp "$kept" "$output"
  echo "done:$name"
  exit
fi
mkdir -p .snakemake/slurm/done
rm -f "$kept" "$kept.settings"
number=$(sbatch --parsable --job-name="$name" --comment="$settings" --dependency=singleton --cpus-per-task="$cpus" --mem="$memory_mb" \
  --time="$minutes" --output=.snakemake/slurm/%j.log "$jobscript" "$name" "$settings" "$output")
echo "${number%%;*}"     # without the name of the cluster
