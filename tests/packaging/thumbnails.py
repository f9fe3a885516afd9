#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""What file managers show of glTF assets, with an installed gltfx.

thumbnails.py PREFIX FOLDER ASSET...: asks tumbler, the service of Xfce, for a thumbnail of each
asset, with gltfx.thumbnailer and gltfx.xml of PREFIX, and draws each once more in the sandbox that
GNOME uses: no network, no other processes, nothing but the asset and the system, read-only. Prints
a line for each; exits with 1 if one has no thumbnail, and with 77 if programs are missing.
"""
import hashlib
import os
import shutil
import subprocess
import sys
import time
import urllib.parse

try:
    import dbus
except ImportError:
    dbus = None

TUMBLER = "/usr/lib/x86_64-linux-gnu/tumbler-1/tumblerd"
NEEDED = ["dbus-run-session", "gdbus", "gio", "update-mime-database", "bwrap"]
SERVICE = "org.freedesktop.thumbnails.Thumbnailer1"
SIDE = 128
MOST_SECONDS = 120  # for one asset, on any machine


def is_png(path):
    try:
        with open(path, "rb") as file:
            head = file.read(24)
    except FileNotFoundError:
        return False
    if head[:8] != b"\x89PNG\r\n\x1a\n":
        return False
    sides = int.from_bytes(head[16:20], "big"), int.from_bytes(head[20:24], "big")
    return 0 < min(sides) and max(sides) <= SIDE


def content_type(path):
    said = subprocess.run(["gio", "info", "-a", "standard::content-type", path],
                          capture_output=True, text=True, check=True).stdout
    return said.split("standard::content-type:")[1].split()[0]


def ask_tumbler(tumbler, path):
    """The type of a file that tumbler makes a thumbnail of, or None. tumbler drops the requests of
    those who leave the bus."""
    uri = "file://" + urllib.parse.quote(path)
    name = hashlib.md5(uri.encode()).hexdigest() + ".png"
    cache = os.path.join(os.environ["XDG_CACHE_HOME"], "thumbnails")
    kind = content_type(path)
    tumbler.Queue([uri], [kind], "normal", "foreground", dbus.UInt32(0), timeout=600)
    end = time.monotonic() + MOST_SECONDS
    while time.monotonic() < end:
        if is_png(os.path.join(cache, "normal", name)):
            return kind
        failed = os.path.join(cache, "fail")
        if any(name in files for _, _, files in os.walk(failed)):
            return None
        time.sleep(0.02)
    return None


def can_sandbox():
    """Not in a container that forbids namespaces."""
    words = ["bwrap", "--ro-bind", "/", "/", "--proc", "/proc", "--dev", "/dev", "--unshare-all", "true"]
    return subprocess.run(words, stderr=subprocess.DEVNULL, check=False).returncode == 0


def draw_in_sandbox(prefix, folder, path):
    """As libgnome-desktop runs the line of the .thumbnailer."""
    with open(os.path.join(prefix, "share/thumbnailers/gltfx.thumbnailer"), encoding="utf-8") as file:
        line = next(row for row in file if row.startswith("Exec="))[5:].split()
    inside = "/tmp/gnome-desktop-file-to-thumbnail" + os.path.splitext(path)[1]
    words = [{"%s": str(SIDE), "%o": "/out/picture", "%i": inside}.get(word, word) for word in line]
    out = os.path.join(folder, "out")
    shutil.rmtree(out, ignore_errors=True)
    os.makedirs(out)
    binds = []
    for system in ("/usr", "/bin", "/lib", "/lib64", "/etc/alternatives", "/etc/ld.so.cache"):
        binds += ["--ro-bind-try", system, system]
    subprocess.run(["bwrap", *binds, "--tmpfs", "/tmp", "--ro-bind", prefix, prefix, "--ro-bind",
                    path, inside, "--bind", out, "/out", "--dev", "/dev", "--proc", "/proc", "--unshare-all",
                    "--die-with-parent", "--chdir", "/", "--clearenv", "--setenv", "PATH",
                    os.path.join(prefix, "bin") + ":/usr/bin", *words], check=False)
    return is_png(os.path.join(out, "picture"))


def give_time(process):
    """tumbler has the least priority, with which it may take forever on a busy machine."""
    for task in os.listdir(f"/proc/{process}/task"):
        try:
            os.sched_setscheduler(int(task), os.SCHED_OTHER, os.sched_param(0))
            os.setpriority(os.PRIO_PROCESS, int(task), 0)
        except (PermissionError, ProcessLookupError):
            pass


def judge(prefix, folder, assets):
    bus = dbus.SessionBus()
    tumbler = dbus.Interface(bus.get_object(SERVICE, "/" + SERVICE.replace(".", "/")), SERVICE)
    failed = 0
    sandboxed = can_sandbox()
    if not sandboxed:
        print("this system forbids namespaces: nothing is drawn in a sandbox")
    for asset in map(os.path.abspath, assets):
        kind = ask_tumbler(tumbler, asset)
        alone = draw_in_sandbox(prefix, folder, asset) if sandboxed and asset.endswith((".glb", ".vrm")) else True
        print(f"{asset}: {kind or 'NO THUMBNAIL'}{'' if alone else ', NONE IN THE SANDBOX'}", flush=True)
        failed += kind is None or not alone
    return 1 if failed else 0


def main():
    prefix, folder, *assets = sys.argv[1:]
    prefix, folder = os.path.abspath(prefix), os.path.abspath(folder)
    if "GLTFX_IN_SESSION" not in os.environ:
        if dbus is None or not os.path.exists(TUMBLER) or not all(shutil.which(each) for each in NEEDED):
            print("tumbler, bubblewrap, python3-dbus or another program is not installed")
            return 77
        shutil.rmtree(folder, ignore_errors=True)
        data = os.path.join(folder, "data")
        os.makedirs(os.path.join(data, "mime/packages"))
        shutil.copy(os.path.join(prefix, "share/mime/packages/gltfx.xml"),
                    os.path.join(data, "mime/packages"))
        subprocess.run(["update-mime-database", os.path.join(data, "mime")], check=True,
                       stderr=subprocess.DEVNULL)
        environment = dict(
            os.environ, GLTFX_IN_SESSION="1", HOME=folder, XDG_DATA_HOME=data,
            XDG_CACHE_HOME=os.path.join(folder, "cache"),
            XDG_DATA_DIRS=os.path.join(prefix, "share") + ":/usr/share",
            PATH=os.path.join(prefix, "bin") + ":" + os.environ["PATH"])
        return subprocess.run(["dbus-run-session", "--", sys.executable, *sys.argv],
                              env=environment, check=False).returncode
    # D-Bus would not wait for its first start on a busy machine.
    service = subprocess.Popen([TUMBLER], stdout=subprocess.DEVNULL)
    subprocess.run(["gdbus", "wait", "--session", "--timeout", "600", SERVICE], check=True)
    give_time(service.pid)
    try:
        return judge(prefix, folder, assets)
    finally:
        service.terminate()


if __name__ == "__main__":
    sys.exit(main())
