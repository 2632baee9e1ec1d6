"""A display without a screen, for as long as it is needed."""
import os
import subprocess


class Screen:
    """Xvfb; `environment` has its DISPLAY, and software for what a graphics card does."""

    def __init__(self, size="1600x1200", log=subprocess.DEVNULL):
        self.size, self.log, self.server, self.environment = size, log, None, {}

    def __enter__(self):
        read, write = os.pipe()
        try:
            command = ["Xvfb", "-displayfd", str(write), "-screen", "0", self.size + "x24", "+extension", "GLX",
                       "-nolisten", "tcp"]
            self.server = subprocess.Popen(command, pass_fds=[write], stdout=self.log, stderr=self.log)
        except FileNotFoundError as error:
            raise SystemExit("monarch: there is no Xvfb; run scripts/install picture") from error
        finally:
            os.close(write)
        with os.fdopen(read) as file:
            number = file.readline().strip()
        if not number:
            raise SystemExit("monarch: Xvfb did not start")
        self.environment = dict(DISPLAY=":" + number, LIBGL_ALWAYS_SOFTWARE="1", QT_X11_NO_MITSHM="1")
        return self

    def __exit__(self, *_):
        self.server.terminate()
        self.server.wait()
