from pool_sim_ros.report.outputs import picture_count, write_pictures


def test_pictures_have_600_dots_per_inch(settings, shots, tmp_path):
    made = dict(write_pictures(tmp_path, settings.table, [shots[3]]))
    assert len(made) == picture_count([shots[3]]) == 5
    for path, vectors in made.items():
        data = (tmp_path / path).read_bytes()
        place = data.index(b'pHYs') + 4
        per_metre = int.from_bytes(data[place : place + 4], 'big')
        assert round(per_metre * 0.0254) == 600
        assert int.from_bytes(data[16:20], 'big') == 3900
        assert b'<svg' in vectors
    assert sorted(p.name for p in (tmp_path / 'images').iterdir()) == sorted(
        path.removeprefix('images/') for path in made
    )


def test_the_same_picture_is_the_same_bytes(settings, shots, tmp_path):
    first, second = (
        dict(write_pictures(tmp_path / name, settings.table, [])) for name in ('a', 'b')
    )
    assert first == second
    for path in first:
        assert (tmp_path / 'a' / path).read_bytes() == (tmp_path / 'b' / path).read_bytes()
