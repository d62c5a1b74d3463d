"""Films as files that browsers play: MP4 with H.264, encoded by imageio-ffmpeg's own ffmpeg."""

from __future__ import annotations

import errno
import os
import subprocess
from collections.abc import Iterable
from pathlib import Path

from pool_sim_ros.report.errors import ReportError


class EncoderError(ReportError):
    """ffmpeg is missing or has failed."""


def encode(frames: Iterable[bytes], size: tuple[int, int], rate: int, path: Path) -> None:
    """Write a film.

    Parameters
    ----------
    frames : iterable of bytes
        Each (height, width, 4) bytes of red, green, blue, alpha; alpha does not count.
    size : tuple of int
        Width and height in pixels, both even.
    rate : int
        Frames per second.
    path : Path

    Raises
    ------
    EncoderError
        Where ffmpeg is missing or fails.
    OSError
        Where the disk is full.
    """
    width, height = size
    source = ['-f', 'rawvideo', '-pix_fmt', 'rgba', '-s', f'{width}x{height}', '-r', str(rate)]
    # sRGB in, the colours of HD television out, and said so in the file, so that no player guesses.
    colors = 'scale=in_range=full:out_range=tv:out_color_matrix=bt709,format=yuv420p,' + (
        'setparams=range=tv:colorspace=bt709:color_primaries=bt709:color_trc=bt709'
    )
    # Old ffmpegs read it here, new ones there.
    tags = ['-color_range', 'tv', '-colorspace', 'bt709']
    tags += ['-color_primaries', 'bt709', '-color_trc', 'bt709']
    # No frame depends on a later one, so that films can be joined without a gap in their times.
    codec = ['-c:v', 'libx264', '-preset', 'medium', '-crf', '18', '-bf', '0', '-g', str(rate)]
    _run([*source, '-i', 'pipe:0', '-vf', colors, *tags, *codec], frames, path)


def join(films: Iterable[Path], path: Path) -> None:
    """Write films of one size and rate one after the other into one; raises as `encode`."""
    # With its protocol, or ffmpeg would take a name as relative to the pipe.
    quoted = (str(film.resolve()).replace("'", r"'\''") for film in films)
    entries = (f"file 'file:{name}'\n" for name in quoted)
    source = ['-f', 'concat', '-safe', '0', '-protocol_whitelist', 'file,pipe']
    _run([*source, '-i', 'pipe:0', '-c', 'copy'], [''.join(entries).encode()], path)


def find_ffmpeg() -> str:
    """Return the path of ffmpeg; raises EncoderError where there is none."""
    import imageio_ffmpeg

    try:
        return imageio_ffmpeg.get_ffmpeg_exe()
    except RuntimeError as error:
        raise EncoderError('no ffmpeg is found; install it, or pass --no-videos') from error


def _run(arguments: list[str], chunks: Iterable[bytes], path: Path) -> None:
    """Have ffmpeg make `path` of what it is sent."""
    command = [find_ffmpeg(), '-nostdin', '-nostats', '-loglevel', 'error', '-y', *arguments]
    command += ['-movflags', '+faststart', '-f', 'mp4', os.fspath(path)]
    # In a session of its own, so that Ctrl-C reaches only us, who then end it.
    process = subprocess.Popen(
        command, stdin=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True
    )
    try:
        try:
            for chunk in chunks:
                process.stdin.write(chunk)
        except BrokenPipeError:
            pass  # It has ended; why is on its standard error.
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
