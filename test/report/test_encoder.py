import errno
import os

import pytest
from film_reader import frame_times, frames

from pool_sim_ros.report.encoder import EncoderError, encode, find_ffmpeg, join
from pool_sim_ros.report.files import OutputError
from pool_sim_ros.report.outputs import write_film


def test_frames_come_back_in_order_and_in_their_colours(tmp_path):
    colors = ((255, 0, 0), (0, 255, 0), (0, 0, 255))
    path = tmp_path / 'film.mp4'
    encode((bytes((*color, 255)) * 64 * 64 for color in colors), (64, 64), 60, path)
    pictures = frames(path, (64, 64))
    assert [tuple(picture[32, 32]) for picture in pictures] == [
        pytest.approx(color, abs=6) for color in colors
    ]
    join([path, path], tmp_path / 'twice.mp4')
    assert frame_times(tmp_path / 'twice.mp4') == list(range(6))


def test_ffmpeg_says_what_is_wrong_in_one_line(tmp_path):
    with pytest.raises(EncoderError, match='^ffmpeg failed: .+$'):
        encode([b'\0' * 64], (4, 4), 60, tmp_path / 'no' / 'such' / 'folder.mp4')


def test_a_full_disk_is_told_when_ffmpeg_meets_it(shots, tmp_path, monkeypatch):
    fake = tmp_path / 'ffmpeg'
    fake.write_text(
        '#!/bin/sh\necho "av_interleaved_write_frame(): No space left on device" >&2\nexit 1\n'
    )
    fake.chmod(0o755)
    monkeypatch.setattr('pool_sim_ros.report.encoder.find_ffmpeg', lambda: str(fake))
    with pytest.raises(OutputError) as caught:
        write_film(tmp_path / 'out', shots[3], (128, 72))
    assert str(caught.value).endswith(f'collision_3.mp4: {os.strerror(errno.ENOSPC)}')
    assert list((tmp_path / 'out' / 'videos').iterdir()) == []


def test_a_missing_ffmpeg_is_told(monkeypatch):
    def fail():
        raise RuntimeError('No ffmpeg exe could be found.')

    monkeypatch.setattr('imageio_ffmpeg.get_ffmpeg_exe', fail)
    with pytest.raises(EncoderError, match='--no-videos'):
        find_ffmpeg()


def test_an_error_while_frames_are_drawn_leaves_no_film_and_no_ffmpeg(tmp_path):
    def frames():
        yield b'\0' * 64
        raise KeyboardInterrupt

    before = set(_children())
    with pytest.raises(KeyboardInterrupt):
        encode(frames(), (4, 4), 60, tmp_path / 'film.mp4')
    assert set(_children()) <= before


def _children():
    path = f'/proc/self/task/{os.getpid()}/children'
    with open(path) as file:
        return file.read().split()
