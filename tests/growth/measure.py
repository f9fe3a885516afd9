# SPDX-License-Identifier: Apache-2.0
"""Runs a program and measures its resources, with the processes that it started.

Each run has a small process of its own between this one and the program: what is resident when a
process is forked counts for the peak of the new one.
"""
import dataclasses
import json
import os
import resource
import subprocess
import sys
import threading

CPU_LIMIT = 60  # seconds
MOST_OUTPUT = 64 << 20
PAUSE = 0.02  # seconds between two looks at the memory of processes that the program started


@dataclasses.dataclass
class Measured:
    seconds: float = float("inf")  # processor time
    peak: int = 0  # bytes, of all processes together
    failure: str = ""

    def best(self, other):
        """The faster one with the lower peak; a failure stays."""
        peak = min(self.peak, other.peak) if self.seconds != float("inf") else other.peak
        return Measured(min(self.seconds, other.seconds), peak, self.failure or other.failure)


def descendants(process):
    found, left = [], [process]
    while left:
        parent = left.pop()
        try:
            for task in os.listdir(f"/proc/{parent}/task"):
                with open(f"/proc/{parent}/task/{task}/children", encoding="ascii") as file:
                    children = [int(word) for word in file.read().split()]
                found += children
                left += children
        except OSError:
            pass
    return found


def high_water(process):
    """Maximum resident bytes, or 0 when the process has ended. Shared memory that workers map
    too counts once, with the program."""
    try:
        with open(f"/proc/{process}/status", encoding="ascii", errors="replace") as file:
            fields = dict(line.split(":", 1) for line in file if ":" in line)
        return int(fields.get("VmHWM", "0 kB").split()[0]) << 10
    except (OSError, ValueError):
        return 0


class Watch(threading.Thread):
    """Notes the peak of each process that the program starts."""

    def __init__(self, process):
        super().__init__(daemon=True)
        self.process = process
        self.done = threading.Event()
        self.peaks = {}

    def run(self):
        while not self.done.wait(PAUSE):
            for child in descendants(self.process):
                # The latest one counts: it restarts when a fork of the program becomes a worker.
                self.peaks[child] = high_water(child) or self.peaks.get(child, 0)


def limits():
    resource.setrlimit(resource.RLIMIT_CPU, (CPU_LIMIT, CPU_LIMIT + 5))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def measure(words, folder):
    told = subprocess.run([sys.executable, "-S", __file__, folder, *words], stdout=subprocess.PIPE,
                          check=True).stdout
    return Measured(**json.loads(told))


def measure_here(words, folder):
    with open(os.path.join(folder, "output"), "wb+") as output:
        process = subprocess.Popen(words, cwd=folder, stdin=subprocess.DEVNULL, stdout=output,
                                   stderr=output, preexec_fn=limits)
        watch = Watch(process.pid)
        watch.start()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        watch.done.set()
        watch.join()
        size = output.tell() or os.fstat(output.fileno()).st_size
        output.seek(max(size - 300, 0))
        last = output.read().decode(errors="replace").strip().splitlines()[-1:]
    # wait4 reports the maximum memory of the program and of the processes it waited for.
    peak = (usage.ru_maxrss << 10) + sum(watch.peaks.values())
    measured = Measured(usage.ru_utime + usage.ru_stime, peak)
    if process.returncode < 0:
        measured.failure = f"ended by signal {-process.returncode}"
    elif process.returncode not in (0, 1, 3):  # 3: a resource cannot be read
        measured.failure = f"exit code {process.returncode}: {' '.join(last)}"
    elif size > MOST_OUTPUT:
        measured.failure = f"{size >> 20} MiB of output"
    return measured


if __name__ == "__main__":
    print(json.dumps(dataclasses.asdict(measure_here(sys.argv[2:], sys.argv[1]))))
