"""Frames to a film, by ffmpeg."""
import os
import pathlib
import subprocess
import sys
import tempfile

# The colours of a GIF are chosen from what changes; ordered dithering keeps it small.
GIF = ("split[a][b];[a]palettegen=max_colors=256:stats_mode=diff[p];"
       "[b][p]paletteuse=dither=bayer:bayer_scale=4:diff_mode=rectangle")
MP4 = ["-c:v", "libx264", "-pix_fmt", "yuv420p", "-crf", "19", "-preset", "medium", "-movflags", "+faststart"]


class Encoder:
    """Writes `path` (.mp4 or .gif), whole or not at all. Frames: RGB, 8 bit, first row on top."""

    def __init__(self, path, size, fps):
        self.path = pathlib.Path(path)
        self.partial = self.path.with_name(f".{self.path.stem}.partial{self.path.suffix}")
        kind = ["-vf", GIF, "-loop", "0"] if self.path.suffix == ".gif" else MP4
        command = ["ffmpeg", "-hide_banner", "-loglevel", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgb24",
                   "-s", f"{size[0]}x{size[1]}", "-r", str(fps), "-i", "-", *kind, str(self.partial)]
        self.log = tempfile.TemporaryFile()
        try:
            self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stderr=self.log)
        except FileNotFoundError:
            sys.exit("film: there is no ffmpeg; run scripts/install film")

    def add(self, frame):
        try:
            self.process.stdin.write(frame.tobytes())
        except BrokenPipeError:
            self.failed()

    def failed(self):
        self.process.wait()
        self.log.seek(0)
        sys.exit(f"film: ffmpeg: {self.log.read().decode(errors='replace').strip()}")

    def __enter__(self):
        return self

    def __exit__(self, error, *_):
        try:
            self.process.stdin.close()
        except BrokenPipeError:
            pass
        if error is None and self.process.wait() == 0:
            os.replace(self.partial, self.path)
            return
        self.process.kill()
        self.process.wait()
        self.partial.unlink(missing_ok=True)
        if error is None:
            self.failed()
