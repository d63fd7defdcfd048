-- Plain-text notation in sentences becomes what it stands for: r_c, ∇_Γ, P_θθ subscripts; u^{n+1}, d^(1/2), nm^3 superscripts.
-- Tables get the widths their cells ask for instead of those of the source's dashes.

local function is_latin(code) return code and (code >= 65 and code <= 90 or code >= 97 and code <= 122) end
local function is_digit(code) return code and code >= 48 and code <= 57 end
local function is_greek(code) return code and code >= 0x391 and code <= 0x3C9 end

-- The script of a letter that a subscript may hold; digits go with Latin letters.
local function script(code)
  return (is_latin(code) or is_digit(code)) and "latin" or is_greek(code) and "greek" or nil
end

-- A symbol of one letter: what `velocity_degree` ends with is none.
local function is_symbol(codes, i)
  local code = codes[i]
  if code == 0x2207 or code == 0x2202 or is_greek(code) then return true end
  return is_latin(code) and not is_latin(codes[i - 1]) and codes[i - 1] ~= 95
end

-- Last index of the subscript that starts at i; nil where none does.
local function subscript_end(codes, i)
  local kind, last = script(codes[i]), i
  if not kind then return nil end
  while script(codes[last + 1]) == kind do last = last + 1 end
  return codes[last + 1] ~= 95 and last or nil
end

-- First and last index of the superscript's text behind a ^ at i, and the index after all of it.
local function superscript(codes, i)
  local closing = ({ [123] = 125, [40] = 41 })[codes[i + 1]]
  if closing then
    for last = i + 2, #codes do
      if codes[last] == closing then return i + 2, last - 1, last + 1 end
    end
    return nil
  end
  local first, last = i + 1, i + 1
  if codes[last] == 45 then last = last + 1 end
  if not is_digit(codes[last]) then return nil end
  while is_digit(codes[last + 1]) do last = last + 1 end
  return first, last, last + 1
end

local function text_of(codes, first, last)
  return first > last and "" or utf8.char(table.unpack(codes, first, last))
end

function Str(element)
  if not element.text:find("[_^]") then return nil end
  local codes, pieces, start, i = {}, pandoc.List(), 1, 2
  for _, code in utf8.codes(element.text) do codes[#codes + 1] = code end
  local function add(make, first, last, after)
    pieces:insert(pandoc.Str(text_of(codes, start, i - 1)))
    pieces:insert(make({ pandoc.Str((text_of(codes, first, last):gsub("-", "−"))) }))
    start, i = after, after - 1
  end
  while i < #codes do
    if codes[i] == 95 and is_symbol(codes, i - 1) then
      local last = subscript_end(codes, i + 1)
      if last then add(pandoc.Subscript, i + 1, last, last + 1) end
    elseif codes[i] == 94 then
      local first, last, after = superscript(codes, i)
      if first then add(pandoc.Superscript, first, last, after) end
    end
    i = i + 1
  end
  if start == 1 then return nil end
  pieces:insert(pandoc.Str(text_of(codes, start, #codes)))
  return pieces
end

function Table(element)
  for _, column in ipairs(element.colspecs) do column[2] = nil end
  return element
end
