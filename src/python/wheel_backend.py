# SPDX-License-Identifier: MIT
"""Builds the package with CMake and packs it as a wheel, for pip and `python3 -m build`; needs nothing but Python.

The wheel is for the Python and the processor of this machine, and uses the shared libraries of the system.
The environment variable TRIBO_ARCH selects another instruction set, as in CMake; it is then built in a folder of its own.
"""

import base64
import hashlib
import io
import os
import pathlib
import re
import subprocess
import sys
import sysconfig
import tarfile
import zipfile

root = pathlib.Path(__file__).resolve().parents[2]
system_python = "/usr/bin/python3"  # of CMakeLists.txt


def version():
    """That of the project."""
    return re.search(r"project\(Tribo VERSION ([\d.]+)", (root / "CMakeLists.txt").read_text()).group(1)


def build():
    """Builds the package; returns its folder."""
    own = "%d.%d" % sys.version_info[:2]
    other = subprocess.run([system_python, "-c", "import sys; print('%d.%d' % sys.version_info[:2])"], check=True,
                           stdout=subprocess.PIPE, text=True).stdout.strip()
    if own != other:
        raise SystemExit(f"the package is built for {system_python}, version {other}; run pip with this Python, not {own}")
    folder, options = "build/release", []
    if "TRIBO_ARCH" in os.environ:
        arch = os.environ["TRIBO_ARCH"]
        folder, options = f"build/python-{arch or 'any'}", [f"-DTRIBO_ARCH={arch}", "-DTRIBO_TESTS=OFF"]
    configure = ["cmake", "--preset", "release", "-B", folder, "-DTRIBO_PYTHON=ON", *options]
    for command in (configure, ["cmake", "--build", folder, "--target", "tribo_python"]):
        subprocess.run(command, cwd=root, check=True, stdout=sys.stderr)
    return root / folder / "python/tribo"


def metadata():
    """What pip knows of the package."""
    return (f"Metadata-Version: 2.1\nName: tribo\nVersion: {version()}\nSummary: Material point method with contact\n"
            "License: MIT\nRequires-Python: >=3.10\nRequires-Dist: numpy\nProvides-Extra: tables\n"
            "Requires-Dist: pandas; extra == 'tables'\nProvides-Extra: pictures\n"
            "Requires-Dist: matplotlib; extra == 'pictures'\n")


def pack(package, folder):
    """Packs a built package as a wheel in a folder; returns its path."""
    python = "cp%d%d" % sys.version_info[:2]
    tag = f"{python}-{python}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"
    about = f"tribo-{version()}.dist-info"
    files = {f"tribo/{p.name}": p.read_bytes() for p in sorted(pathlib.Path(package).iterdir()) if p.suffix in (".py", ".so")}
    files[f"{about}/METADATA"] = metadata().encode()
    files[f"{about}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: tribo\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()
    record = ""
    for name, data in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        record += f"{name},sha256={digest},{len(data)}\n"
    files[f"{about}/RECORD"] = (record + f"{about}/RECORD,,\n").encode()
    path = pathlib.Path(folder) / f"tribo-{version()}-{tag}.whl"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as wheel:
        for name, data in files.items():
            entry = zipfile.ZipInfo(name)
            entry.compress_type, entry.external_attr = zipfile.ZIP_DEFLATED, 0o644 << 16
            wheel.writestr(entry, data)
    return path


def archive(folder):
    """The files of the last commit as an archive of sources, with their names below tribo-VERSION; returns its path."""
    name = f"tribo-{version()}"
    path = pathlib.Path(folder) / f"{name}.tar.gz"
    files = subprocess.run(["git", "archive", "--format=tar", f"--prefix={name}/", "HEAD"], cwd=root, check=True,
                           stdout=subprocess.PIPE).stdout
    with tarfile.open(fileobj=io.BytesIO(files)) as committed, tarfile.open(path, "w:gz", format=tarfile.PAX_FORMAT) as packed:
        for member in committed:
            packed.addfile(member, committed.extractfile(member) if member.isfile() else None)
        about = tarfile.TarInfo(f"{name}/PKG-INFO")
        about.size, about.mtime, about.mode = len(metadata().encode()), member.mtime, 0o644
        packed.addfile(about, io.BytesIO(metadata().encode()))
    return path


def get_requires_for_build_wheel(config_settings=None):
    """Of PEP 517: nothing."""
    return []


def get_requires_for_build_sdist(config_settings=None):
    """Of PEP 517: nothing."""
    return []


def build_sdist(sdist_directory, config_settings=None):
    """Of PEP 517."""
    return archive(sdist_directory).name


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """Of PEP 517."""
    return pack(build(), wheel_directory).name


if __name__ == "__main__":  # wheel_backend.py FOLDER: builds and unpacks the wheel into a folder of packages
    target = pathlib.Path(sys.argv[1])
    target.mkdir(parents=True, exist_ok=True)
    built = pack(build(), target)
    with zipfile.ZipFile(built) as archive:
        archive.extractall(target)
    built.unlink()
    print(f"tribo {version()} is in {target}")
