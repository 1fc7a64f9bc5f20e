#!/usr/bin/env python3
"""Says which files include what their layer may not, and exits with 1 if any does.

The layers are the folders of src/duskline; MAY_INCLUDE is the whole rule. Each library we stand on is
hidden in one place (EXTERNAL), and headers that users get include none of them.

usage: tools/check_layers.py [ROOT]      ROOT: the project's folder
"""

import pathlib
import re
import sys

MAY_INCLUDE = {
    "geometry": set(),
    "execution": set(),
    "terrain": {"geometry", "execution"},
    "light": {"geometry"},
    "casting": {"geometry", "execution", "terrain", "light"},
    "products": {"geometry", "execution", "terrain", "light", "casting"},
    # Files know grids, heights, masks and planets' sources, report progress, and turn the sun's azimuth to the raster's north.
    "raster_io": {"geometry", "execution", "terrain", "light", "casting", "planet"},
    # Cameras and what of a terrain they see; no OpenGL.
    "view": {"geometry", "execution", "terrain"},
    # Globes, their tiles, and what of them a camera sees; no OpenGL.
    "planet": {"geometry", "execution", "terrain", "view"},
    "gl": {"geometry", "execution", "terrain", "light", "casting", "view", "planet"},
}

# Include lines of a library -> the folder, or folders, that may have them. Examples may show OpenGL of their own.
EXTERNAL = {
    r"tbb/|oneapi/": "src/duskline/execution",
    r"hwy/": "src/duskline/casting/kernels",
    r"erfa": "src/duskline/light",
    r"(gdal|ogr|cpl|vrt|proj)[\w]*\.h": "src/duskline/raster_io",
    r"webp/": "src/duskline/raster_io",
    r"epoxy/|GL/|EGL/|GLES": ("src/duskline/gl", "examples"),
    r"CLI/|nlohmann/|fmt/": "apps",
    r"GLFW/|imgui": ("apps/viewer", "apps/planet", "apps/window"),
}

SOURCES = {".h", ".hpp", ".inl", ".cpp", ".cc"}


def includes_of(file):
    text = file.read_text(encoding="utf-8", errors="replace")
    return re.findall(r'^[ \t]*#[ \t]*include[ \t]*[<"]([^>"]+)[>"]', text, re.MULTILINE)


def source_files(folder):
    return sorted(file for file in folder.rglob("*") if file.suffix in SOURCES)


def installed_headers(root):
    lists = root / "src/duskline/CMakeLists.txt"
    return set(re.findall(r"[\w/]+\.h\b", lists.read_text())) if lists.exists() else set()


def wrong_layers(root):
    library = root / "src/duskline"
    for file in source_files(library):
        layer = file.relative_to(library).parts[0]
        if layer not in MAY_INCLUDE:
            yield f"{file.relative_to(root)}: no layer is called {layer}; MAY_INCLUDE in check_layers.py lists them"
            continue
        for included in includes_of(file):
            other = re.match(r"duskline/(\w+)/", included)
            if other and other[1] != layer and other[1] not in MAY_INCLUDE[layer]:
                yield f"{file.relative_to(root)}: {layer} may not include {other[1]} (<{included}>)"


def wrong_external(root):
    public = installed_headers(root)
    for folder in ("src/duskline", "apps", "examples"):
        for file in source_files(root / folder):
            name = file.relative_to(root).as_posix()
            for included in includes_of(file):
                homes = [home for pattern, home in EXTERNAL.items() if re.match(pattern, included)]
                homes = [folder for home in homes for folder in ([home] if isinstance(home, str) else home)]
                if homes and not any(name.startswith(home + "/") for home in homes):
                    yield f"{name}: only {homes[0]}/ may include <{included}>"
                elif homes and name.removeprefix("src/duskline/") in public:
                    yield f"{name}: a header that is installed may not include <{included}>"


def wrong_programs(root):
    """Programs are made of the library; nothing is made of programs."""
    for folder in ("src", "apps", "tests", "bench", "examples", "fuzz"):
        for file in source_files(root / folder):
            own = file.relative_to(root).parts[:2]
            for included in includes_of(file):
                program = re.search(r"(?:^|/)(apps)/(\w+)/", included)
                if program and program.groups() != own:
                    yield f"{file.relative_to(root)}: programs may not be included (<{included}>)"


def wrong_includes(root):
    return [*wrong_layers(root), *wrong_external(root), *wrong_programs(root)]


if __name__ == "__main__":
    project = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent)
    if not source_files(project / "src/duskline"):
        sys.exit(f"check_layers: {project} has no sources under src/duskline")
    problems = wrong_includes(project)
    print("\n".join(problems) or "every include is where it may be")
    sys.exit(bool(problems))
