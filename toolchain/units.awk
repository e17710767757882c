# Shares the sources of rooms out to translation units: prints a line "unit source" for each source it is given. A unit
# holds sources of one room, none of whose private names (the unnamed namespace's, at the start of a line as clang-format
# leaves them) is another's. Macros in capitals, such as GoogleTest's, name nothing.

function declared(line) {
  while (sub(/\[\[[^\]]*\]\] */, "", line)) {}
  if (match(line, /^(struct|class|union|enum class|enum) +[A-Za-z_0-9]+/)) {
    line = substr(line, 1, RLENGTH)
    sub(/.* /, "", line)
    return line
  }
  if (!match(line, /[A-Za-z_0-9]+ *[({=;[]/)) return ""
  line = substr(line, RSTART, RLENGTH)
  sub(/ *.$/, "", line)
  return line
}

FNR == 1 { private = 0; files[++count] = FILENAME }
/^namespace \{/ { private = 1; next }
/^\}  \/\/ namespace$/ { private = 0 }
private && /^[A-Za-z[]/ && !/^template/ && !/^[A-Z_]+\(/ {
  name = declared($0)
  if (name != "" && !((FILENAME, name) in known)) {
    known[FILENAME, name] = 1
    names[FILENAME] = names[FILENAME] " " name
  }
}

END {
  for (i = 1; i <= count; ++i) {
    room = files[i]
    sub(/\/[^\/]*$/, "", room)
    gsub(/[^A-Za-z0-9]/, "_", room)
    wanted = split(names[files[i]], own, " ")
    for (number = 1;; ++number) {
      unit = room "_" number
      clash = size[unit] >= largest
      for (k = 1; k <= wanted; ++k) clash = clash || ((unit, own[k]) in taken)
      if (!clash) break
    }
    for (k = 1; k <= wanted; ++k) taken[unit, own[k]] = 1
    ++size[unit]
    print unit, files[i]
  }
}
