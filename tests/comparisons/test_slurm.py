"""A sweep's array and MPI runs on a real Slurm: munged, slurmctld and slurmd of Debian (slurm-wlm, munge), started by the test for itself.

Left out where these programs are missing, or without root, whom slurmd needs.
"""

import csv
import json
import os
import shutil
import socket
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

import locations  # noqa: F401
from command import words
from engines import options
from studies import BOUNDARY_INTEGRAL, StudyTest, SweepTest

NEEDED = ("munged", "slurmctld", "slurmd", "sbatch", "squeue")
PATHS = "/usr/sbin:/sbin:" + os.environ.get("PATH", "")
MISSING = [name for name in NEEDED if shutil.which(name, path=PATHS) is None]

#: The program itself, and the engine beside it.
PROGRAM = os.path.abspath(os.environ.get("ENDOFLOW_PROGRAM", "endoflow"))
ENGINE = Path(PROGRAM).with_name("endoflow-phase-field")

#: Most seconds for the cluster to be ready, and for an array to end: the time limit of a minute is in it, and Slurm's own periods.
READY, ENDED = 120, 900

CONFIGURATION = """
ClusterName=endoflow
SlurmctldHost={host}(127.0.0.1)
AuthType=auth/munge
AuthInfo=socket={directory}/munge.socket
CredType=cred/munge
CryptoType=crypto/munge
SlurmUser=root
SlurmdUser=root
SlurmctldPort={controller}
SlurmdPort={daemon}
StateSaveLocation={directory}/state
SlurmdSpoolDir={directory}/spool
SlurmctldPidFile={directory}/slurmctld.pid
SlurmdPidFile={directory}/slurmd.pid
SlurmctldLogFile={directory}/slurmctld.log
SlurmdLogFile={directory}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerType=sched/backfill
ReturnToService=2
KillWait=30
InactiveLimit=0
NodeName={host} NodeAddr=127.0.0.1 CPUs={cores} State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


def free_port():
    """A TCP port that nothing listens at."""
    with socket.socket() as own:
        own.bind(("127.0.0.1", 0))
        return own.getsockname()[1]


class Cluster:
    """One node that is this machine, in a directory (Path) of its own."""

    def __init__(self, directory):
        self.directory, self.processes = directory, []
        self.environment = {**os.environ, "PATH": PATHS, "SLURM_CONF": str(directory / "slurm.conf")}

    def start(self):
        """Start munged, the controller and the node; raises RuntimeError when they do not become ready."""
        for name in ("state", "spool", "munge"):
            (self.directory / name).mkdir(mode=0o700)
        key = self.directory / "munge" / "key"
        key.write_bytes(os.urandom(1024))
        key.chmod(0o600)
        cores = min(2, os.cpu_count())
        (self.directory / "slurm.conf").write_text(
            CONFIGURATION.format(
                host=socket.gethostname().split(".")[0],
                directory=self.directory,
                controller=free_port(),
                daemon=free_port(),
                cores=cores,
            )
        )
        inside = self.directory / "munge"
        names = ("socket", "pid-file", "log-file", "seed-file")
        places = [f"--{name}={inside / name}" for name in names if name != "socket"]
        self._run("munged", "--foreground", "--force", f"--socket={self.directory}/munge.socket", f"--key-file={key}", *places)
        self._until("munged listens", lambda: (self.directory / "munge.socket").exists())
        self._run("slurmctld", "-D")
        self._run("slurmd", "-D")
        self._until("the node is idle", lambda: "idle" in self.ask("sinfo", "-h", "-o", "%T"))

    def ask(self, *command):
        """What a command of Slurm prints."""
        return subprocess.run(command, env=self.environment, capture_output=True, text=True, timeout=60).stdout

    def wait(self):
        """Until no job is left."""
        self._until("the queue is empty", lambda: not self.ask("squeue", "-h").strip(), ENDED)

    def stop(self):
        """End all that was started, last first."""
        for process in reversed(self.processes):
            process.terminate()
            try:
                process.wait(20)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()

    def _run(self, *command):
        log = open(self.directory / f"{command[0]}.out", "w", encoding="utf-8")
        with log:
            self.processes.append(subprocess.Popen(command, env=self.environment, stdout=log, stderr=log))

    def _until(self, what, true, seconds=READY):
        end = time.monotonic() + seconds
        while not true():
            if time.monotonic() > end or any(process.poll() is not None for process in self.processes):
                logs = "".join(path.read_text(errors="replace")[-1500:] for path in self.directory.glob("*.log"))
                logs += "".join(path.read_text(errors="replace")[-1500:] for path in self.directory.glob("*.out"))
                raise RuntimeError(f"Slurm: {what}: not within {seconds} s\n{logs}")
            time.sleep(0.5)


class ClusterTest(StudyTest):
    """Adds self.cluster, which runs."""

    def setUp(self):
        super().setUp()
        # A socket's path has at most 107 letters.
        holder = tempfile.TemporaryDirectory(prefix="slurm", dir="/tmp")
        self.addCleanup(holder.cleanup)
        self.cluster = Cluster(Path(holder.name))
        self.addCleanup(self.cluster.stop)
        self.cluster.start()


@unittest.skipIf(MISSING, f"Slurm is not installed ({', '.join(MISSING)}; Debian packages slurm-wlm and munge)")
@unittest.skipIf(os.geteuid() != 0, "slurmd needs root")
class OnSlurm(ClusterTest, SweepTest):
    #: Twelve members: a radius of 17 fails, one of 22 does not end before its time limit while the file `slow` is there.
    ARRAY = ("--vary", "molecules.patch_radius=17,18,19,20,21,22,23,24,25,26,27,28", *BOUNDARY_INTEGRAL)

    def submit(self, *options):
        """sbatch the sweep's script; returns when the queue is empty."""
        process = subprocess.run(
            ["sbatch", "--parsable", *options, "out/case/sweep/sweep.sbatch"],
            cwd=self.scratch,
            env={**self.cluster.environment, "ENDOFLOW_PROGRAM": str(self.program)},
            capture_output=True,
            text=True,
        )
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        self.cluster.wait()

    def states(self, directory="out/case/sweep"):
        return {row["molecules.patch_radius"]: row["state"] for row in self.rows(directory)}

    def test_failure_time_limit_and_second_submission(self):
        (self.scratch / "slow").write_text("22")
        process = self.sweep(*self.ARRAY, "--slurm")
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        self.assertIn("12 of 12 runs left", process.stdout)
        self.submit("--time=1")
        self.sweep(*self.ARRAY, "--collect")
        wanted = {str(radius): "finished" for radius in range(18, 29)} | {"17": "failed", "22": "interrupted"}
        self.assertEqual(self.states(), wanted)
        self.assertEqual(len(self.runs()), 12)

        (self.scratch / "slow").unlink()
        self.submit("--time=1")
        again = self.runs()
        self.assertEqual(
            again,
            ["out/case/sweep/patch_radius=17/boundary-integral fresh", "out/case/sweep/patch_radius=22/boundary-integral restart"],
        )
        self.sweep(*self.ARRAY, "--collect")
        self.assertEqual(self.states(), wanted | {"22": "finished"})

        self.assertEqual(self.sweep(*self.ARRAY, "-o", "plain").returncode, 3)
        tables = [self.rows(), self.rows("plain")]
        for row in (row for table in tables for row in table):
            row["directory"] = Path(row["directory"]).parent.name
        self.assertEqual(*tables)


@unittest.skipIf(MISSING, f"Slurm is not installed ({', '.join(MISSING)}; Debian packages slurm-wlm and munge)")
@unittest.skipIf(os.geteuid() != 0, "slurmd needs root")
@unittest.skipUnless(ENGINE.is_file(), "the phase-field engine was not built")
class MpiOnSlurm(ClusterTest):
    """The diffuse engine with two tasks: started by Slurm itself (srun, PMIx), and by OpenMPI's mpirun in an array's member."""

    #: Two steps of a thick layer.
    SHORT = ("--until", "2e-5", *options(("phase_field.epsilon=2.4", "output.field_interval=0")))

    def slurm(self, *words):
        """Run a command of Slurm, which succeeds; returns what it printed."""
        environment = {**self.cluster.environment, "ENDOFLOW_PROGRAM": PROGRAM}
        process = subprocess.run(words, cwd=self.scratch, env=environment, capture_output=True, text=True, timeout=ENDED)
        self.assertEqual(process.returncode, 0, process.stderr)
        return process.stdout

    def srun(self, output, *options):
        return ("srun", "--ntasks=2", "--mpi=pmix", PROGRAM, "run", "phase-field", "case.toml", "-o", output, *options)

    def last(self, directory):
        """(run.json, last row of history.csv) of a run."""
        record = json.loads((self.scratch / directory / "run.json").read_text())
        with open(self.scratch / directory / "history.csv", newline="", encoding="utf-8") as file:
            return record, [*csv.DictReader(file)][-1]

    def test_srun_and_mpirun(self):
        self.slurm(*self.srun("by_srun", *self.SHORT))
        sweep = ("sweep", "case.toml", "--engine", "phase-field", "--vary", "molecules.patch_radius=36", "--processes", "2", *self.SHORT)
        environment = {**os.environ, "ENDOFLOW_PROGRAM": PROGRAM}
        for option in ("--slurm", "--collect"):
            command = [*words(*sweep), option]
            process = subprocess.run(command, cwd=self.scratch, env=environment, capture_output=True, text=True, timeout=ENDED)
            self.assertEqual(process.returncode, 0, process.stderr)
            if option == "--slurm":
                self.slurm("sbatch", "--wait", "out/case/sweep/sweep.sbatch")
        runs = [self.last(name) for name in ("by_srun", "out/case/sweep/patch_radius=36/phase-field")]
        for record, _ in runs:
            self.assertEqual((record["state"], record["processes"]), ("finished", 2))
        # The same processes, the same sums: nothing but the order of OpenMPI's reductions may differ.
        heights = [float(row["bud_height_nm"]) for _, row in runs]
        self.assertAlmostEqual(heights[0] / heights[1], 1, delta=1e-8)

    def test_a_signal_leaves_a_checkpoint(self):
        """scancel --signal=INT reaches both tasks; a second submission goes on."""
        job = self.slurm("sbatch", "--parsable", "--ntasks=2", "--wrap", " ".join(self.srun("run", *self.SHORT[2:]))).strip()
        history = self.scratch / "run" / "history.csv"
        end = time.monotonic() + ENDED
        while not (history.exists() and history.read_text().count("\n") > 2):
            self.assertLess(time.monotonic(), end, self.cluster.ask("squeue"))
            time.sleep(0.5)
        self.slurm("scancel", "--signal=INT", job)
        self.cluster.wait()
        record, row = self.last("run")
        self.assertEqual((record["state"], record["processes"]), ("interrupted", 2))
        reached = float(row["time_us"])
        self.slurm(*self.srun("run", *self.SHORT[2:], "--until", f"{1.5 * reached:.12g}", "--restart"))
        record, row = self.last("run")
        self.assertEqual(record["state"], "finished")
        self.assertAlmostEqual(float(row["time_us"]) / reached, 1.5, delta=1e-9)


if __name__ == "__main__":
    unittest.main()
