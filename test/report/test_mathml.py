import latex2mathml  # noqa: F401 - the test is skipped without it

from pool_sim_ros.report.mathml import with_formulae


def test_formulae_become_mathml_with_their_numbers():
    html = with_formulae(r'a \(x_1\) b \[ y = 2 , \quad z = 3 \tag{7} \] c')
    assert html.count('<math') == 3
    assert '<span class="number">(7)</span>' in html
    assert '<msub><mi>x</mi><mn>1</mn></msub>' in html
    assert html.startswith('a <math')
    assert html.endswith('</div> c')


def test_text_without_formulae_stays_as_it_is():
    html = '<p>f(x) costs 3 $ [sic]</p>'
    assert with_formulae(html) == html


def test_a_displayed_formula_without_a_number_has_none():
    html = with_formulae(r'\[ a = b \]')
    assert 'class="number"' not in html
    assert 'display="block"' in html
