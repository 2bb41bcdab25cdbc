#!/bin/sh
# Gives a job of the workflow to Slurm and prints its number there. Of a workflow that was killed jobs go on: such a one, of the same
# settings, is taken up again, or if it has ended meanwhile taken as it is; one of other settings is let end first, since both write
# the same file.
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
# What is not queued any more has left what it made, until status.sh has told of it: Snakemake removes what it does not know to be whole.
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
echo "${number%%;*}"     # without the cluster's name
