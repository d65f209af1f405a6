#!/bin/bash
# status.sh JOB: says running, success or failed, as Snakemake asks. No accounting is needed.
if ! said=$(scontrol show job --oneliner "$1" 2>&1); then
  # Long ago Slurm forgets a job. A controller that does not answer says nothing of it.
  [[ $said == *"Invalid job id"* ]] && echo failed || echo running
  exit
fi
[[ $said =~ \ JobState=([A-Z_]+) ]]
case ${BASH_REMATCH[1]} in
  COMPLETED) echo success ;;
  BOOT_FAIL | CANCELLED | DEADLINE | FAILED | NODE_FAIL | OUT_OF_MEMORY | PREEMPTED | TIMEOUT) echo failed ;;
  *) echo running ;;
esac
