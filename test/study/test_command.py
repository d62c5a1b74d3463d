"""`python -m pool_sim_ros.study`."""

import pytest
import xarray
from sweeping import NAMES, TABLE, TEXTS, assert_same_bits

from pool_sim_ros.study.command import main
from pool_sim_ros.study.sweeps import sweep


def test_it_sweeps_and_draws(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    args = [
        '--samples',
        '3',
        '--seed',
        '7',
        '--workers',
        '0',
        '--quiet',
        '--keep',
        'finals',
        'failed',
    ]
    assert main(['sweep', 'report', 'a.zarr', *TEXTS, *args]) == 0
    assert (
        capsys.readouterr().out == 'a.zarr: 90 shots (angle 30 x sample 3): failed, finals, speed\n'
    )
    expected = sweep(TABLE, samples=3, seed=7, keep=['finals', 'failed'], progress=False, **NAMES)
    assert_same_bits(xarray.open_zarr('a.zarr').load(), expected)


def test_a_picture_of_a_window(tmp_path, monkeypatch):
    pytest.importorskip('matplotlib')
    monkeypatch.chdir(tmp_path)
    main(['sweep', 'report', 'a.zarr', 'angle=0:90:5', 'speed=1:2:3', '--workers', '0', '--quiet'])
    assert main(['plot', 'a.zarr', 'a.png', '--what', 'first_hit']) == 0
    assert main(['plot', 'a.zarr', 'b.png', '--ball', '9', '--window', 'angle=10:12']) == 0
    assert (
        (tmp_path / 'a.png').read_bytes()[1:4] == (tmp_path / 'b.png').read_bytes()[1:4] == b'PNG'
    )


def test_a_table_from_a_file(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    TABLE.save('mine.json')
    args = ['a.zarr', 'angle=1,2', 'speed=1', '--workers', '0', '--quiet']
    assert main(['sweep', 'mine.json', *args]) == 0


SWEEP = ['sweep', 'report', 'a.zarr']


@pytest.mark.parametrize(
    ('args', 'said'),
    [
        ([*SWEEP, 'angle'], "'angle' is not NAME=VALUE"),
        ([*SWEEP, 'anglr=1'], 'anglr: there is no such input'),
        ([*SWEEP, 'angle=1,2', 'angle=3'], 'angle: it is given twice'),
        ([*SWEEP, 'angle=1,x', 'speed=2'], 'angle=1,x: is not as in'),
        ([*SWEEP, 'angle=1,2'], 'speed: it is missing'),
        ([*SWEEP, 'angle=uniform(1,2)', 'speed=2'], 'samples: it is missing'),
        ([*SWEEP, 'angle=1,2', 'speed=2', '--keep', 'all'], "keep: 'all' is no outcome"),
        ([*SWEEP, 'velocity=1,2', 'speed=2'], 'velocity: there is no such input'),
        (['sweep', '6ft', 'a', 'angle=1'], "table: '6ft' is neither a file nor one of"),
        (
            ['sweep', 'report', '.', 'angle=1,2', 'speed=2', '--workers', '0'],
            'no sweep of this package',
        ),
        (['plot', 'nothing.zarr', 'a.png'], 'nothing.zarr: there is no such folder'),
        (['plot', '.', 'a.png'], 'no sweep of this package'),
    ],
)
def test_mistakes_are_one_line(tmp_path, monkeypatch, capsys, args, said):
    monkeypatch.chdir(tmp_path)
    (tmp_path / 'mine').write_text('')
    assert main(args) == 1
    told = capsys.readouterr()
    assert said in told.err and told.err.count('\n') == 1 and told.out == ''
    assert [path.name for path in tmp_path.iterdir()] == ['mine']
