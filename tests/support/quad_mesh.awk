# SPDX-License-Identifier: Apache-2.0
# Open Inventor text (what ivcat prints) with one textured QuadMesh, made an OBJ with its material
# and texture, for test heads. Usage: ivcat HEAD.iv | awk -v out=FOLDER/NAME -f quad_mesh.awk
function byte(hex, at) {
  return 16 * index("123456789abcdef", substr(hex, at, 1)) + index("123456789abcdef", substr(hex, at + 1, 1))
}
function take(line) {  # numbers of a point list
  gsub(/[^-0-9.e \t]/, " ", line)
  n = split(line, part, /[ \t]+/)
  for (i = 1; i <= n; ++i) if (part[i] ~ /[0-9]/) list[++count] = part[i]
}
/Texture2 \{/ { inside = "image" }
/TextureCoordinate2 \{/ { inside = "uv" }
/Coordinate3 \{/ { inside = "point" }
/Material \{/ { inside = "" }
/verticesPerColumn/ { columns = $2 }
/verticesPerRow/ { rows = $2 }
inside == "image" && $1 == "image" { width = $2; height = $3 }
inside == "image" {
  n = split($0, part, /[ \t]+/)
  for (i = 1; i <= n; ++i) if (part[i] ~ /^0x/) {
    hex = substr("000000" substr(part[i], 3), length(part[i]) - 1)
    texel[++texels] = hex
  }
}
(inside == "uv" || inside == "point") && /[0-9]/ {
  line = $0
  sub(/point[ \t]*\[/, "", line)
  if (line !~ /\{/) {
    count = 0
    take(line)
    step = inside == "uv" ? 2 : 3
    for (i = 1; i + step - 1 <= count; i += step)
      if (inside == "uv") uv[++uvs] = list[i] " " list[i + 1]
      else point[++points] = list[i] " " list[i + 1] " " list[i + 2]
  }
}
/\]/ { if (inside != "image") inside = "" }
/^[ \t]*\}/ { inside = "" }
END {
  name = out; sub(/.*\//, "", name)
  print "P3\n" width " " height "\n255" > (out ".ppm")
  for (y = height - 1; y >= 0; --y)
    for (x = 1; x <= width; ++x) {
      hex = texel[y * width + x]
      print byte(hex, 1), byte(hex, 3), byte(hex, 5) > (out ".ppm")
    }
  print "newmtl skin\nKd 1 1 1\nmap_Kd " name ".ppm" > (out ".mtl")
  print "mtllib " name ".mtl\nusemtl skin" > (out ".obj")
  for (i = 1; i <= points; ++i) print "v " point[i] > (out ".obj")
  for (i = 1; i <= uvs; ++i) print "vt " uv[i] > (out ".obj")
  for (r = 0; r + 1 < columns; ++r)
    for (c = 1; c < rows; ++c) {
      a = r * rows + c; b = a + 1; d = a + rows; e = d + 1
      print "f " a "/" a, b "/" b, e "/" e, d "/" d > (out ".obj")
    }
}
