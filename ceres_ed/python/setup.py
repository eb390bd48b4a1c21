"""Makes a wheel of the Python package, with the programs in its bin/.

CMake builds everything: in build/wheel below the sources or, if they cannot be written, in a temporary
folder. CERES_ED_WHEEL_BUILD names another build folder (relative to the sources), which may have been
built already.
A source archive (sdist) has the sources of the library in its folder sources/.
"""
import atexit
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext
from setuptools.command.install_scripts import install_scripts
from setuptools.command.sdist import sdist

HERE = Path(__file__).resolve().parent
ROOT = HERE / "sources" if (HERE / "sources").is_dir() else HERE.parent.parent
# What the library, the programs and the package are built from.
SOURCES = ["CMakeLists.txt", "LICENSE", "README.md", "apps", "ceres_ed", "cost_functions",
           "data/CMakeLists.txt", "data/make_pairs.cc", "data/make_shapes.cc", "scripts/cmake",
           "scripts/demo.sh"]
OPTIONS = ["-DCMAKE_BUILD_TYPE=Release", "-DBUILD_SHARED_LIBS=OFF", "-DCERES_ED_BUILD_TESTS=OFF",
           "-DCERES_ED_BUILD_BENCHMARKS=OFF", "-DCERES_ED_BUILD_APPS=ON",
           "-DCERES_ED_BUILD_PYTHON=ON", "-DCERES_ED_BUILD_PCL=OFF", "-DCERES_ED_BUILD_VIDEO=OFF",
           f"-DPython3_EXECUTABLE={sys.executable}"]


def version():
    """Returns the version of the library."""
    return re.search(r"project\(ceres_ed VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text())[1]


def run(*command):
    """Runs a program. A failure ends the build with the program's own message."""
    try:
        subprocess.run([str(word) for word in command], check=True)
    except FileNotFoundError:
        sys.exit(f"ceres_ed: there is no {command[0]}; scripts/setup.sh python installs what is needed")
    except subprocess.CalledProcessError as error:
        sys.exit(f"ceres_ed: {command[0]} ended with exit code {error.returncode}")


def build_folder():
    """Returns the folder in which CMake builds, and whether it is to be made here."""
    given = os.environ.get("CERES_ED_WHEEL_BUILD")
    if given:
        folder = ROOT / given
        if (folder / "CMakeCache.txt").exists():
            return folder, False
        return folder, True
    if os.access(ROOT, os.W_OK) and not (HERE / "sources").is_dir():
        return ROOT / "build" / "wheel", True
    return Path(tempfile.mkdtemp(prefix="ceres_ed_wheel_")), True


def check_static(build):
    """Refuses a build folder with a shared library, which a wheel has no place for."""
    if re.search(r"^BUILD_SHARED_LIBS:\w+=(ON|1|TRUE|YES)$", (build / "CMakeCache.txt").read_text(),
                 re.MULTILINE | re.IGNORECASE):
        sys.exit(f"ceres_ed: {build} has a shared libceres_ed, expected BUILD_SHARED_LIBS=OFF")


def configure(build):
    options = list(OPTIONS)
    if shutil.which("ninja"):
        options.append("-GNinja")
    if shutil.which("ccache"):
        options.append(f"-DCMAKE_CXX_COMPILER_LAUNCHER=env;CCACHE_BASEDIR={ROOT};CCACHE_NOHASHDIR=1;ccache")
    run("cmake", "-S", ROOT, "-B", build, *options)


def installed(stage):
    """Builds, installs package and programs to `stage`, and returns the folder of the package."""
    build, new = build_folder()
    if new:
        configure(build)
    check_static(build)
    programs = re.findall(r"ceres_ed_add_app\((ed_\w+)", (ROOT / "apps/CMakeLists.txt").read_text())
    jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL") or str(os.cpu_count() or 1)
    # What is installed with the programs: their man pages and completions.
    pages = [f"{program}_pages" for program in programs]
    run("cmake", "--build", build, "--parallel", jobs, "--target", "ceres_ed_python", *programs, *pages)
    for component in ("python", "tools"):
        # CMake leaves the paths of the build out of what it installs.
        run("cmake", "--install", build, "--prefix", stage, "--component", component)
    return next(stage.glob("**/ceres_ed/_core.*.so")).parent


class BuildWithCMake(build_ext):
    """Builds the module and the programs."""

    def run(self):
        stage = Path(self.build_temp).resolve() / "stage"
        shutil.rmtree(stage, ignore_errors=True)
        package = installed(stage)
        (module,) = package.glob("_core.*.so")
        if not module.name.endswith(sysconfig.get_config_var("EXT_SUFFIX")):
            sys.exit(f"ceres_ed: {module.name} was built for another Python than {sys.executable}")
        target = Path(self.get_ext_fullpath("ceres_ed._core"))
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(module, target)
        programs = Path(self.build_temp) / "programs"
        shutil.rmtree(programs, ignore_errors=True)
        programs.mkdir(parents=True)
        for program in sorted((stage / "bin").glob("ed_*")):
            shutil.copy(program, programs)


class InstallPrograms(install_scripts):
    """Puts the programs into the bin/ of the wheel, as they are."""

    def run(self):
        super().run()
        programs = Path(self.get_finalized_command("build_ext").build_temp) / "programs"
        folder = Path(self.install_dir)
        folder.mkdir(parents=True, exist_ok=True)
        for program in sorted(programs.iterdir()):
            self.outfiles.append(shutil.copy(program, folder))


class SourceArchive(sdist):
    """Adds the sources of the library, without which nobody can build the archive."""

    def make_release_tree(self, base_dir, files):
        super().make_release_tree(base_dir, files)
        ignored = shutil.ignore_patterns("__pycache__", "build", "dist", Path(base_dir).name)
        for name in SOURCES:
            target = Path(base_dir) / "sources" / name
            target.parent.mkdir(parents=True, exist_ok=True)
            if (ROOT / name).is_dir():
                shutil.copytree(ROOT / name, target, ignore=ignored)
            else:
                shutil.copy(ROOT / name, target)


# What setuptools writes beside its results does not belong among the sources.
scratch = tempfile.mkdtemp(prefix="ceres_ed_setup_")
atexit.register(shutil.rmtree, scratch, ignore_errors=True)

setup(version=version(),
      options={"build": {"build_base": scratch}, "egg_info": {"egg_base": scratch}},
      ext_modules=[Extension("ceres_ed._core", sources=[])],
      cmdclass={"build_ext": BuildWithCMake, "install_scripts": InstallPrograms, "sdist": SourceArchive})
