# SPDX-License-Identifier: GPL-2.0-or-later
"""Pages from templates: README.md of a study, and one HTML file that holds its pictures."""
from __future__ import annotations

import base64
import io
import math
from pathlib import Path

import jinja2
import pandas
from markupsafe import Markup, escape
from PIL import Image

COMMON = Path(__file__).resolve().parent
LARGEST_PAGE = 2_000_000  # bytes
MINUS = "−"               # a hyphen is shorter and lower


def figure(value, digits: int = 3) -> str:
    """`digits` significant digits, never as 1e+05: 0.000123, 45.6, −12300."""
    value = float(value)
    if not math.isfinite(value):
        return "–"
    if value == 0:
        return "0"
    rounded = float(f"{value:.{digits - 1}e}")
    decimals = max(0, digits - 1 - math.floor(math.log10(abs(rounded))))
    return f"{rounded:.{decimals}f}".replace("-", MINUS)


def fixed(value, decimals: int = 2) -> str:
    """So many digits after the point; a dash for no number."""
    value = float(value)
    return f"{value:.{decimals}f}".replace("-", MINUS) if math.isfinite(value) else "–"


def power(value, digits: int = 1) -> str:
    """6·10⁻⁶, for numbers of any size."""
    value = float(value)
    if not math.isfinite(value):
        return "–"
    if value == 0:
        return "0"
    mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
    raised = str(int(exponent)).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
    return f"10{raised}" if mantissa == "1" else f"{mantissa.replace('-', MINUS)}·10{raised}"


def with_error(pair, decimals: int = 4) -> str:
    """mean ± error, the mean alone where there is no error."""
    mean, error = pair
    if not math.isfinite(error):
        return fixed(mean, decimals)
    return f"{fixed(mean, decimals)} ± {fixed(error, decimals)}"


FILTERS = {"figure": figure, "fixed": fixed, "power": power, "with_error": with_error}


def markdown_table(headings, rows) -> str:
    """A table of Markdown from texts."""
    lines = [headings, ["---"] * len(headings), *rows]
    return "\n".join("| " + " | ".join(map(str, line)) + " |" for line in lines)


def html_table(headings, rows) -> Markup:
    """A table of HTML from texts, in a box that scrolls if the window is narrow."""
    def line(cells, tag):
        return "<tr>" + "".join(f"<{tag}>{escape(c)}</{tag}>" for c in cells) \
            + "</tr>"
    body = "\n".join(line(row, "td") for row in rows)
    return Markup(
        f'<div class="wide"><table>\n<thead>{line(headings, "th")}</thead>\n<tbody>\n{body}\n'
        f"</tbody></table></div>")


def shrink(path: Path | str, out: Path | str, across: int, colours: int = 255) -> None:
    """A rendered picture made at most `across` pixels wide with few colours, about a tenth of its
    bytes."""
    picture = Image.open(path).convert("RGB")
    across = min(across, picture.width)
    height = round(picture.height * across / picture.width)
    picture = picture.resize((across, height), Image.LANCZOS)
    picture.quantize(colours, dither=Image.Dither.NONE).save(out, optimize=True)


def data_url(path: Path | str, widest: int = 1200, quality: int = 82) -> str:
    """A picture as text for an HTML page: as WebP, at most `widest` pixels across."""
    picture = Image.open(path).convert("RGB")
    if picture.width > widest:
        picture = picture.resize((widest, round(picture.height * widest / picture.width)),
                                 Image.LANCZOS)
    stream = io.BytesIO()
    picture.save(stream, "WEBP", quality=quality, method=6)
    return "data:image/webp;base64," + base64.b64encode(stream.getvalue()).decode()


def _environment(template: Path, html: bool) -> jinja2.Environment:
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader([template.parent, COMMON]), undefined=jinja2.StrictUndefined,
        autoescape=html, trim_blocks=True, lstrip_blocks=True, keep_trailing_newline=True)
    environment.filters.update(FILTERS)
    environment.globals.update(table=html_table if html else markdown_table, isnan=pandas.isna)
    return environment


def _write(text: str, out: Path | str) -> None:
    out = Path(out)
    out.parent.mkdir(parents=True, exist_ok=True)
    unfinished = out.with_name(out.name + ".new")
    unfinished.write_text(text, encoding="utf-8")
    unfinished.replace(out)


def render(template: Path | str, out: Path | str, values: dict) -> None:
    """Writes a page from a template; a value that is not there is an error."""
    template = Path(template).resolve()
    _write(_environment(template, False).get_template(template.name).render(values), out)


def html_page(template: Path | str, out: Path | str, values: dict) -> None:
    """The same for HTML: the template extends page.html.j2 and takes pictures in by
    `{{ picture(path, text) }}`. Refuses more than LARGEST_PAGE bytes."""
    template = Path(template).resolve()
    environment = _environment(template, True)

    def picture(path, text, **options):
        return Markup(
            f'<img alt="{escape(text)}" src="{data_url(path, **options)}">')

    environment.globals.update(picture=picture)
    page = environment.get_template(template.name).render(values)
    size = len(page.encode())
    if size > LARGEST_PAGE:
        raise ValueError(f"{out} would have {size} bytes, more than {LARGEST_PAGE}: "
                         f"take smaller pictures")
    _write(page, out)
