"""Runs programs side by side, each on one core."""

import contextlib
import fcntl
import os
import signal
import subprocess
import sys
import threading
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait

from cases import ENVIRONMENT


def lock(folder):
    """A file that runs keep open, so that no two of them write the same
    results, whatever becomes of this process."""
    folder.mkdir(parents=True, exist_ok=True)
    file = open(folder / "lock", "w")
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        sys.exit(f"Other runs are at work in {folder}: wait for them or take "
                 "another --folder")
    return file


class Runner:
    def __init__(self, programs, lock_file):
        self.programs = programs
        self.lock_file = lock_file
        self.guard = threading.Lock()
        self.processes = {}
        self.stopped = None

    def stop(self, number, _):
        """End after the present step of each run; the runs write
        checkpoints."""
        with self.guard:
            self.stopped = number
            for process in self.processes.values():
                # not terminate(), which might take the exit code
                with contextlib.suppress(ProcessLookupError):
                    os.kill(process.pid, signal.SIGTERM)

    def start(self, run):
        with self.guard:
            if self.stopped:
                return None
            resumed = run.prepare()
            with open(run.log, "a") as log:
                # its own session: Ctrl-C reaches a run once, from here
                process = subprocess.Popen(
                    [self.programs / run.program, run.file, "--output",
                     run.results, *(["--resume"] if resumed else [])],
                    stdout=log, stderr=log, env={**os.environ, **ENVIRONMENT},
                    start_new_session=True, pass_fds=[self.lock_file.fileno()])
            self.processes[run] = process
        return process

    def run(self, run):
        """Returns nothing after a good run, else what went wrong."""
        try:
            process = self.start(run)
        except OSError as error:
            return str(error)
        if process is None:
            return None
        _, status, usage = os.wait4(process.pid, 0)
        with open(run.times, "a") as file:
            file.write(f"{usage.ru_utime + usage.ru_stime:.2f}\n")
        with self.guard:
            # it has been waited for; so it is told
            process.returncode = os.waitstatus_to_exitcode(status)
            del self.processes[run]
        if process.returncode == 0 or self.stopped:
            return None
        lines = run.log.read_text(errors="replace").split("\n")
        last = [l for l in lines if l.strip()][-1:] or ["no message"]
        return f"{last[0].strip()} (exit code {process.returncode}, {run.log})"

    def progress(self, done, total):
        parts = []
        for run in list(self.processes):
            strain = run.strain()
            at = "starts" if strain is None else \
                f"at {strain:.1f} of {run.length():g}"
            parts.append(f"{run.name} {at}")
        return f"{done} of {total} done; " + ", ".join(parts)


def execute(runs, programs, folder, jobs):
    """Do what is left to do, the cheap ones first. Returns the runs that
    failed."""
    left = sorted((r for r in runs if r.state() != "complete"),
                  key=lambda r: r.cost())
    if not left:
        return []
    lock_file = lock(folder)
    runner = Runner(programs, lock_file)
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, runner.stop)

    on_terminal = sys.stdout.isatty()
    clear = "\r\033[K" if on_terminal else ""
    failed, done = [], 0
    with ThreadPoolExecutor(jobs) as pool:
        waiting = {pool.submit(runner.run, run): run for run in left}
        while waiting:
            finished, _ = wait(waiting, 1., FIRST_COMPLETED)
            if on_terminal:
                print(f"{clear}{runner.progress(done, len(left))}", end="",
                      flush=True)
            for future in finished:
                run = waiting.pop(future)
                problem = future.result()
                if runner.stopped:
                    continue
                done += 1
                print(f"{clear}{done} of {len(left)}: {run.name}  " +
                      (f"FAILED: {problem}" if problem else
                       f"{run.seconds():.0f} s"), flush=True)
                if problem:
                    failed.append(run)
    if runner.stopped:
        print(f"{clear}Stopped: the same command goes on")
        sys.exit(128 + runner.stopped)
    return failed
