-- Links between pages go to the HTML pages; those that leave docs/ to the source tree.
local up = os.getenv("ENDOFLOW_DOCS_UP")

function Link(link)
  local target = link.target
  if target:match("^%a+:") or target:match("^#") then return nil end
  if target:match("^%.%./%.%./") or (target:match("^%.%./") and not target:match("%.md")) then
    link.target = up .. "/" .. target
  else
    link.target = target:gsub("%.md$", ".html"):gsub("%.md#", ".html#")
  end
  return link
end
