"""`endoflow movie`: the film it writes, read back with ffprobe, and its messages."""

import json
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import locations  # noqa: F401
import numpy as np
import synthetic
from command import CommandTest, call
from scratch import scratch_directory


def movie(*arguments, **environment):
    return call("movie", *arguments, **environment)


class Movie(CommandTest):
    @classmethod
    def setUpClass(cls):
        cls.scratch = scratch_directory(cls)
        cls.run_, _ = synthetic.write_pair(cls.scratch, count=9)

    def probe(self, file):
        """(codec, width, height, frames) of a film."""
        entries = "stream=codec_name,width,height,nb_read_frames"
        answer = subprocess.run(
            ["ffprobe", "-v", "error", "-count_frames", "-show_entries", entries, "-of", "json", str(file)],
            capture_output=True,
            text=True,
            check=True,
        )
        stream = json.loads(answer.stdout)["streams"][0]
        return stream["codec_name"], stream["width"], stream["height"], int(stream["nb_read_frames"])

    @unittest.skipUnless(shutil.which("ffmpeg"), "ffmpeg is not installed (Debian package ffmpeg)")
    def test_films(self):
        for name, codec in (("film.mp4", "h264"), ("film.gif", "gif")):
            with self.subTest(name):
                output = self.scratch / "films" / name
                process = movie(self.run_, "-o", output, "--seconds", 1, "--fps", 12, "--width", 321)
                self.assertEqual((process.returncode, process.stderr), (0, ""))
                self.assertEqual(self.probe(output), (codec, 320, 180, 12))
        self.assertEqual(sorted(path.name for path in output.parent.iterdir()), ["film.gif", "film.mp4"])

    def test_without_ffmpeg(self):
        process = movie(self.run_, "-o", self.scratch / "none.mp4", PATH=str(self.scratch))
        self.assert_one_line(process, 4, "endoflow movie: ffmpeg is not installed; install the Debian package ffmpeg")
        self.assertFalse((self.scratch / "none.mp4").exists())

    def test_ffmpeg_that_fails(self):
        tools = self.scratch / "tools"
        tools.mkdir()
        (tools / "ffmpeg").write_text("#!/bin/sh\necho 'Unknown encoder' >&2\nexit 1\n")
        (tools / "ffmpeg").chmod(0o755)
        process = movie(self.run_, "-o", self.scratch / "none.mp4", PATH=str(tools))
        self.assert_one_line(process, 4, "endoflow movie: ffmpeg: Unknown encoder")
        self.assertFalse((self.scratch / "none.mp4").exists())

    def test_bad_input(self):
        self.assert_one_line(movie(self.run_, "-o", "film.avi"), 2, "a film's name ends in .mp4 or .gif")
        self.assert_one_line(movie(self.scratch / "absent"), 4, "no such directory")
        self.assertEqual(movie().returncode, 2)


class Frames(unittest.TestCase):
    def test_most_frames_show_an_early_budding(self):
        from comparisons.drawing.film import EARLY_SHARE, frame_times

        with tempfile.TemporaryDirectory() as scratch:
            import endoflow

            times = np.linspace(0.0, 20.0, 41)
            directory = synthetic.write_run(
                Path(scratch), "boundary-integral", lambda t: synthetic.budding_membrane(min(t, 1.0), 1.0), times
            )
            run = endoflow.load(directory)
            frames = frame_times(run, 100)
            self.assertEqual((frames[0], frames[-1]), (0.0, 20.0))
            early = (frames <= 1.25 * run.event_time("budding") * (1 + 1e-12)).sum()
            self.assertEqual(early, round(EARLY_SHARE * 100))


if __name__ == "__main__":
    unittest.main()
