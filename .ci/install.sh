# install_packages FILE: the Debian 12 packages that FILE names, one a line, which are not here yet. Sourced from the repository's root.
install_packages() {
  local package missing=() as_root=()
  while read -r package; do
    case "$package" in
      ''|'#'*) continue ;;
      nodejs|npm) command -v npm >/dev/null && continue ;;
    esac
    dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed || missing+=("$package")
  done < "$1"
  [ "${#missing[@]}" -gt 0 ] || return 0
  echo "Installing ${missing[*]}"
  [ "$(id -u)" -eq 0 ] || as_root=(sudo)
  "${as_root[@]}" apt-get update -q
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "${missing[@]}"
}
