# Sourced by ./demo and ./check: what both do before they run anything.
# Needs: root = the project's folder.

# The packages a list names, comments left out.
packages_of() { sed -e 's/#.*//' "$@" | tr -s '[:space:]' '\n' | sed '/^$/d'; }

# Installs what is missing of the named lists, after saying so; does nothing, and needs no network, when nothing is.
install_packages() {
    if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
        echo "This is not Debian: install what these packages hold, build with 'cmake --preset release', and use build/bin:" >&2
        packages_of "$@" | xargs echo "   " >&2
        return 0
    fi
    local missing
    missing=$(for package in $(packages_of "$@"); do
        dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' || echo "$package"
    done | xargs)
    [ -z "$missing" ] && return 0
    if [ "$(id -u)" -ne 0 ]; then
        echo "Some packages are missing. Type this, then run me again:" >&2
        echo "    sudo apt-get update && sudo apt-get install --no-install-recommends $missing" >&2
        return 2
    fi
    echo "Installing with apt-get: $missing"
    local log
    log=$(mktemp)
    if ! { apt-get update -q && DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends $missing; } \
        >"$log" 2>&1 </dev/null; then
        tail -n 20 "$log" >&2
        echo "apt-get could not install them; its whole output is in $log" >&2
        return 1
    fi
    rm -f "$log"
}

# Builds targets of the release preset into build/: build_release TESTS(ON|OFF|AUTO) TARGET...
build_release() {
    local tests=$1
    shift
    (
        cd "$root"
        log=$(mktemp)
        if [ "$tests" = AUTO ]; then tests=(); else tests=("-DGOALMOUTH_TESTS=$tests"); fi
        if ! cmake --preset release "${tests[@]}" >"$log" 2>&1; then
            cat "$log" >&2
            echo "The build could not be configured." >&2
            exit 1
        fi
        rm -f "$log"
        cmake --build build --target "$@"
    )
}
