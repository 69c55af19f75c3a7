# A minute before its time is up the task is told so (USR1). It then ends between two frames and is queued again, as it is when a folder is
# busy (75) or the program was killed, ten times at most; what is there is kept. If Slurm itself ends it (TERM), Slurm decides.
tries=10
"$immerse" "$@" &
program=$!
ended=
trap 'kill -TERM "$program"' USR1
trap 'ended=1; kill -TERM "$program"' TERM
wait "$program"
code=$?
# A signal ends the waiting before it ends the program.
while kill -0 "$program" 2>/dev/null; do
  wait "$program"
  code=$?
done
if [ -z "$ended" ] && [ "${SLURM_RESTART_COUNT:-0}" -lt "$tries" ] && { [ "$code" = 75 ] || [ "$code" -gt 128 ]; }; then
  echo "ended with $code, queued again"
  scontrol requeue "$SLURM_JOB_ID"
fi
exit "$code"
