"""Films as files that browsers play: MP4 with H.264, from the ffmpeg of imageio-ffmpeg."""

from __future__ import annotations

import errno
import os
import subprocess
from collections.abc import Iterable
from pathlib import Path

from pool_sim_ros.report.errors import ReportError


class EncoderError(ReportError):
    """ffmpeg is missing, or it failed."""


def encode(
    frames: Iterable[bytes | memoryview], size: tuple[int, int], rate: int, path: Path
) -> None:
    """Write a film.

    Parameters
    ----------
    frames : iterable of bytes or memoryview
        Each (height, width, 4) bytes of red, green, blue, alpha; alpha is ignored.
    size : tuple of int
        Width and height in pixels, both even.
    rate : int
        Frames per second.
    path : Path

    Raises
    ------
    EncoderError
        If ffmpeg is missing or fails.
    OSError
        If the disk is full.
    """
    width, height = size
    source = ['-f', 'rawvideo', '-pix_fmt', 'rgba', '-s', f'{width}x{height}', '-r', str(rate)]
    # sRGB in, the colours of HD television out. The file names them, so that no player guesses.
    colors = 'scale=in_range=full:out_range=tv:out_color_matrix=bt709,format=yuv420p,' + (
        'setparams=range=tv:colorspace=bt709:color_primaries=bt709:color_trc=bt709'
    )
    # Old versions of ffmpeg read these, new ones the filter above.
    tags = ['-color_range', 'tv', '-colorspace', 'bt709']
    tags += ['-color_primaries', 'bt709', '-color_trc', 'bt709']
    # No frame depends on a later one, so films can be joined without a gap in their times.
    codec = ['-c:v', 'libx264', '-preset', 'medium', '-crf', '18', '-bf', '0', '-g', str(rate)]
    _run([*source, '-i', 'pipe:0', '-vf', colors, *tags, *codec], frames, path)


def join(films: Iterable[Path], path: Path) -> None:
    """Join films of one size and rate into one file, in order; raises as `encode`."""
    # Without its protocol ffmpeg takes a name as relative to the pipe.
    quoted = (str(film.resolve()).replace("'", r"'\''") for film in films)
    entries = (f"file 'file:{name}'\n" for name in quoted)
    source = ['-f', 'concat', '-safe', '0', '-protocol_whitelist', 'file,pipe']
    _run([*source, '-i', 'pipe:0', '-c', 'copy'], [''.join(entries).encode()], path)


def find_ffmpeg() -> str:
    """Return the path of ffmpeg; raises EncoderError if there is none."""
    import imageio_ffmpeg

    try:
        return str(imageio_ffmpeg.get_ffmpeg_exe())
    except RuntimeError as error:
        raise EncoderError('no ffmpeg is found; install it, or pass --no-videos') from error


def _run(arguments: list[str], chunks: Iterable[bytes | memoryview], path: Path) -> None:
    """Run ffmpeg with `chunks` on its standard input; it writes `path`."""
    command = [find_ffmpeg(), '-nostdin', '-nostats', '-loglevel', 'error', '-y', *arguments]
    command += ['-movflags', '+faststart', '-f', 'mp4', os.fspath(path)]
    # In a session of its own, so that Ctrl-C reaches only this process, which then ends ffmpeg.
    process = subprocess.Popen(
        command, stdin=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True
    )
    assert process.stdin is not None
    try:
        try:
            for chunk in chunks:
                process.stdin.write(chunk)
        except BrokenPipeError:
            pass  # ffmpeg has ended; its standard error says why.
        _, complaints = process.communicate()
    finally:
        if process.poll() is None:
            process.kill()
            process.communicate()
    if process.returncode:
        _fail(complaints.decode(errors='replace'))


def _fail(complaints: str) -> None:
    full = os.strerror(errno.ENOSPC)
    if full in complaints:
        raise OSError(errno.ENOSPC, full)
    lines = complaints.strip().splitlines() or ['it does not say why']
    raise EncoderError(f'ffmpeg failed: {lines[-1]}')
