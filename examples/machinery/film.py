#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""A picture and a film of one of these decks, in one command: the meshes and the run too if its dump is not there.

    ./film.py drum                      # in.drum -> dump.drum -> drum.png, drum.webp
    ./film.py hopper --film hopper.gif --every 1 --rate 12.5 -var time 1.0
    ./film.py chute --film chute.mp4    # by ffmpeg

.webp, .gif and .png are put together here (python3-pil), .mp4 and .webm by rod_render (ffmpeg).
"""
import argparse
import importlib.util
import shutil
import subprocess
import sys
import tempfile
from itertools import islice
from pathlib import Path

HERE = Path(__file__).resolve().parent
BUILT = HERE.parent.parent / "build" / "release"
SPEED = ["--colour", "speed"]
# What is drawn with the rods, how, and the step of the picture over the steps of the run.
VIEWS = {
    "drum": (["--mesh", "drum_*.stl", *SPEED, "--range", "0", "0.8"], 1.0),
    "hopper": (["--mesh", "hopper.stl", "--top", "0.1", "--view", "side", "--cut", *SPEED, "--range", "0", "1.2"], 0.2),
    "press": (["--vessel-radius", "0.04", "--vessel-height", "0.12", "--body", "press_*.stl",
               "--range", "0", "90"], 0.5),
    "mixer": (["--vessel-radius", "0.06", "--body", "mixer_*.stl", *SPEED, "--range", "0", "0.4"], 1.0),
    "chute": (["--mesh", "chute.stl", "--mesh", "chute_bin.stl", *SPEED, "--range", "0", "1.2"], 0.6),
    "conveyor": (["--body", "belt.stl", "--body", "cross_belt.stl", "--mesh", "belt_rails.stl", *SPEED,
                  "--range", "0", "0.6"], 0.7),
    "trough": (["--mesh", "trough_*.stl", *SPEED, "--range", "0", "0.6"], 0.55),
    "vane": (["--vessel-radius", "0.045", "--body", "vane_*.stl", "--cut", *SPEED, "--range", "0", "0.01"], 1.0),
}


def at_least_one(word: str) -> int:
    number = int(word)
    if number < 1:
        raise ValueError
    return number


def pixels(word: str) -> str:
    width, height = word.split("x")
    return f"{at_least_one(width)}x{at_least_one(height)}"


def percent(word: str) -> int:
    number = int(word)
    if not 0 <= number <= 100:
        raise ValueError
    return number


def pace(word: str) -> float:
    number = float(word)
    if not 0 < number <= 1000:
        raise ValueError
    return number


at_least_one.__name__, pixels.__name__ = "whole number >= 1", "WIDTHxHEIGHT"
percent.__name__, pace.__name__ = "whole number from 0 to 100", "number > 0 and <= 1000"


def program(name: str, given: str | None) -> str:
    found = given or shutil.which(BUILT / name) or shutil.which(name)
    if not found:
        sys.exit(f"film.py: {name} is not there: build it by scripts/build, or say where it is by --{name}")
    return found


def run(command: list, out=None) -> None:
    done = subprocess.run(command, stdout=out)
    if done.returncode != 0:
        sys.exit(f"film.py: {Path(command[0]).name} ended with {done.returncode}, see above")


def without_variables(words: list[str]) -> tuple[list[str], dict[str, str]]:
    """What is for film.py, and what -var NAME VALUE sets in the deck."""
    own, variables = [], {}
    place = 0
    while place < len(words):
        if words[place] not in ("-var", "-v"):
            own.append(words[place])
            place += 1
            continue
        if len(words) < place + 3:
            sys.exit(f"film.py: {words[place]} wants a name and a value (got '{' '.join(words[place + 1:])}')")
        variables[words[place + 1]] = words[place + 2]
        place += 3
    if "out" in variables:
        sys.exit(f"film.py: -var out is for runs alone: all files are here where film.py is called (got '{variables['out']}')")
    return own, variables


def meshes_of(variables: dict[str, str]) -> list[str]:
    """The hopper's mesh has the orifice, the chute's the slope that its deck is told of."""
    return [word for name in ("orifice", "slope") if name in variables for word in (f"--{name}", variables[name])]


def frames_of(dump: Path):
    """Its steps as text."""
    lines = []
    with dump.open() as text:
        for line in text:
            if line.startswith("ITEM: TIMESTEP") and lines:
                yield "".join(lines)
                lines = []
            lines.append(line)
    yield "".join(lines)


def joined(pictures: list[Path], film: Path, rate: float, quality: int) -> None:
    from PIL import Image

    images = [Image.open(picture).convert("RGB") for picture in pictures]
    more = {"duration": round(1000 / rate), "loop": 0, "save_all": True}
    if film.suffix == ".webp":
        more |= {"quality": quality, "method": 6, "minimize_size": True}
    else:  # one palette for all, so that what rests does not flicker
        some = images[::max(1, len(images) // 8)]
        width, height = some[0].size
        sheet = Image.new("RGB", (width, height * len(some)))
        for place, image in enumerate(some):
            sheet.paste(image, (0, height * place))
        palette = sheet.quantize(128)
        images = [image.quantize(palette=palette, dither=Image.Dither.NONE) for image in images]
    images[0].save(film, append_images=images[1:], **more)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0], allow_abbrev=False,
                                     epilog="-var NAME VALUE, any number of times: a variable of the deck")
    parser.add_argument("deck", choices=sorted(VIEWS))
    parser.add_argument("--film", type=Path, help="default NAME.webp")
    parser.add_argument("--size", type=pixels, default="480x400", help="of the film, in pixels (default 480x400)")
    parser.add_argument("--every", type=at_least_one, default=2, help="of the dump's steps (default 2)")
    parser.add_argument("--steps", type=at_least_one, help="at most so many of these (default all)")
    parser.add_argument("--rate", type=pace, default=25, help="pictures a second (default 25)")
    parser.add_argument("--quality", type=percent, default=60, help="of .webp, 0 to 100 (default 60)")
    parser.add_argument("--picture-size", type=pixels, default="640x480")
    parser.add_argument("--lmp", help="the program (default build/release/lmp, else that on the path)")
    parser.add_argument("--rod_render", help="likewise")
    own, variables = without_variables(sys.argv[1:])
    wanted, settings = parser.parse_known_args(own)  # the rest goes to the run, as do variables: -var number 200
    settings += [word for name, value in variables.items() for word in ("-var", name, value)]
    film = wanted.film or Path(f"{wanted.deck}.webp")
    if film.suffix not in (".webp", ".gif", ".png", ".mp4", ".webm"):
        sys.exit(f"film.py: --film must end in .webp, .gif, .png, .mp4 or .webm (got '{film}')")

    by_ffmpeg = film.suffix in (".mp4", ".webm")
    missing = ("" if shutil.which("ffmpeg") else "ffmpeg") if by_ffmpeg else \
        ("" if importlib.util.find_spec("PIL") else "python3-pil")
    if missing:
        sys.exit(f"film.py: {film} wants {missing}, which is not installed")

    dump = Path(f"dump.{wanted.deck}")
    if not dump.exists():
        run([sys.executable, HERE / "make_meshes.py", *meshes_of(variables)])
        run([program("lmp", wanted.lmp), "-in", f"in.{wanted.deck}", *settings])
    elif settings:
        sys.exit(f"film.py: {' '.join(settings)} would go to the run, but {dump} is there already")

    view, part = VIEWS[wanted.deck]
    draw = [program("rod_render", wanted.rod_render)]
    same = [*view, "--timestep", "2e-5"]
    with tempfile.TemporaryDirectory() as folder:
        thin = Path(folder, "dump")
        kept = list(islice(frames_of(dump), 0, None, wanted.every))[:wanted.steps]
        if not kept[0].startswith("ITEM: TIMESTEP"):
            sys.exit(f"film.py: {dump} holds no step (expected a dump of in.{wanted.deck})")
        thin.write_text("".join(kept))
        step = kept[round(part * (len(kept) - 1))].split("\n")[1]
        still = f"{wanted.deck}.png"
        run([*draw, thin, "--out", still, "--frame", step, "--size", wanted.picture_size, *same], subprocess.DEVNULL)
        drawn = [*draw, thin, "--out", Path(folder, "f.png"), "--frame", "all", "--size", wanted.size,
                 "--no-colour-bar", *same]
        if by_ffmpeg:
            drawn += ["--film", film, "--rate", str(wanted.rate)]
        run(drawn, subprocess.DEVNULL)
        if not by_ffmpeg:
            joined(sorted(Path(folder).glob("f_*.png")), film, wanted.rate, wanted.quality)
    print(f"{still}, {film}")


if __name__ == "__main__":
    main()
