# Writes a .cpp that holds a text file as scene_schema(). Run with -DINPUT=... -DOUTPUT=...
# In pieces, because a string literal may be limited to 64 KiB; the delimiter must not occur in the text.
file(READ "${INPUT}" text)
string(LENGTH "${text}" length)
set(pieces "")
set(start 0)
while(start LESS length)
  string(SUBSTRING "${text}" ${start} 4000 piece)
  string(APPEND pieces "R\"schema(${piece})schema\"\n")
  math(EXPR start "${start} + 4000")
endwhile()
file(WRITE "${OUTPUT}" "#include \"scene/schema.hpp\"\n\nnamespace lanecast {\n\n"
  "std::string_view scene_schema() noexcept { return\n${pieces};\n}\n\n} // namespace lanecast\n")
