"""The report's page, for jinja2. It refers to nothing outside itself, and prints on A4."""

PAGE = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{{ title }}</title>
<style>
  body { font-family: "DejaVu Sans", Arial, sans-serif; font-size: 14px; color: #222; max-width: 1300px; margin: 24px auto; padding: 0 24px; line-height: 1.45; }
  h1 { font-size: 25px; margin-bottom: 4px; }
  h2 { font-size: 19px; border-bottom: 2px solid #0b4f9e; padding-bottom: 3px; margin-top: 36px; }
  h3 { font-size: 15px; margin-bottom: 4px; }
  img { width: 100%; height: auto; display: block; margin: 8px 0; }
  table { border-collapse: collapse; margin: 10px 0; }
  th, td { padding: 3px 9px; text-align: left; border-bottom: 1px solid #ddd; vertical-align: top; }
  th { background: #eef2f7; }
  td.n, th.n { text-align: right; white-space: nowrap; }
  .wide, .picture { overflow-x: auto; } p, li, h1, h2, h3 { overflow-wrap: anywhere; } .overview { font-size: 13px; }
  .path { overflow-wrap: anywhere; } td.path { min-width: 180px; }
  .quiet { color: #666; } td.limits { min-width: 150px; color: #7a5200; } tr.limits td { color: #7a5200; padding-top: 0; } #scans tbody tr:not(:last-child) td { border-bottom: none; }
  .warning { background: #fff6dd; border-left: 4px solid #f2b705; padding: 5px 10px; }
  .no { color: #1b7a3d; font-weight: bold; } .yes { color: #b3201d; font-weight: bold; } .marginal { color: #9a6b00; font-weight: bold; }
  ul { padding-left: 20px; }
  pre { background: #f6f6f6; padding: 10px; font-size: 12px; white-space: pre-wrap; overflow-wrap: anywhere; }
  .figures { columns: 3; column-gap: 24px; }
  .figures div { break-inside: avoid; display: flex; justify-content: space-between; border-bottom: 1px dotted #ccc; padding: 1px 0; gap: 12px; }
  .figures span:last-child { text-align: right; } .cleaning th:first-child { min-width: 90px; } summary { cursor: pointer; }
  @page { size: A4; margin: 12mm 12mm 14mm 12mm; @bottom-right { content: counter(page) " / " counter(pages); font-size: 9px; color: #666; } }
  /* pictures keep a size that can be read, and scroll in their own box */
  @media screen and (max-width: 900px) { body { padding: 0 12px; } .figures { columns: 2; } .picture img { width: 860px; max-width: none !important; } }
  @media screen and (max-width: 600px) { .figures { columns: 1; } }
  @media screen and (max-width: 1400px) { th.n, td.n { white-space: normal; } .overview { font-size: 12px; } td.path { min-width: 110px; } }
  @media print {
    body { font-size: 9.5px; line-height: 1.3; margin: 0; padding: 0; max-width: none; }
    h1 { font-size: 20px; } h2 { font-size: 14px; margin: 8px 0 3px; } h3 { font-size: 11px; margin: 5px 0 2px; } .warning { padding: 2px 8px; }
    .head, .cleaning { break-inside: avoid; } tr, img, #scans tbody { break-inside: avoid; } h2, h3 { break-after: avoid; } thead { display: table-header-group; }
    img { margin: 2px auto; } p, table, .figures { margin: 3px 0; } .figures { columns: 4; font-size: 8px; column-gap: 12px; line-height: 1.3; }
    .maps img { width: 74%; } .details img { width: auto; max-width: 54%; max-height: 54mm; } .surface img { width: 74%; } .trends img { width: 62%; }
    .cleaning .beside { display: flex; gap: 3mm; align-items: flex-start; } .cleaning .picture { width: 63%; } .cleaning .picture img { width: auto; max-width: 100% !important; max-height: 44mm; margin: 2px 0; } .cleaning .wide { width: 36%; } .cleaning table { font-size: 7px; line-height: 1.2; }
    #scans td.path { min-width: 0; overflow-wrap: break-word; } .cleaning td, .cleaning th { padding: 1px 4px; }
    .settings { display: none; } .appendix { font-size: 7.5px; } .cleaning th:first-child { min-width: 0; } .appendix ul { margin: 2px 0; columns: 2; } th, td { padding: 2px 4px; } th.n, td.n { white-space: normal; } td.path { min-width: 34mm; } .overview { font-size: 8.5px; width: 100%; }
  }
</style>
</head>
<body>
<h1>{{ title }}</h1>
<p class="quiet">mems_stiction {{ version }}, {{ date }}</p>
<p>{{ summary }}{% if measurements %} {{ measurements }}{% endif %}</p>

<h2>{% if has_device %}The device{% else %}Materials and loads{% endif %}</h2>
<div class="figures" id="device">{% for label, value in device %}<div><span>{{ label }}</span><span>{{ value }}</span></div>{% endfor %}</div>

{% if parts %}<h2>Parts</h2>
<div class="wide"><table class="overview" id="parts">
<thead><tr><th>part</th><th>serial number</th><th>verdict</th><th class="n">{{ judged_by }}</th><th class="n">spread of its logarithm</th><th class="n">lowest of one scan (its number)</th><th class="n">scans that count</th><th>reason</th><th>outside the model's range, of any scan; warnings</th></tr></thead>
<tbody>
{% for part in parts %}<tr><td class="path">{{ part.part }}</td><td class="path">{{ part.serial }}</td><td class="{{ part.sticks }}">{{ part.releases }}</td><td class="n">{{ part.ratio }}</td><td class="n">{{ part.spread }}</td><td class="n">{{ part.worst }}</td><td class="n">{{ part.scans }}</td><td>{{ part.reason }}</td><td class="limits">{{ part.limits }}</td></tr>
{% endfor %}</tbody>
</table></div>
<p class="quiet">{{ parts_caption }}</p>{% endif %}
{% if lots %}<div id="lots"><h2>Lots and wafers</h2>
<ul>{% for statement in lots.statements %}<li>{{ statement }}</li>{% endfor %}</ul>
<div class="picture"><img alt="How far lots, wafers and parts differ, and which share is expected to stick" src="{{ lots.picture }}"></div>
{% for name, map in lots.maps %}<div class="picture"><img alt="Maps of {{ name }}" src="{{ map }}"></div>
{% endfor %}{% if lots.has_more %}<p class="quiet">Of the maps the first {{ lots.maps | length }}; compare_lots --maps draws all.</p>{% endif %}</div>{% endif %}

<h2>Scans</h2>
{% set columns = (8 if has_device else 6) + (1 if has_half_space else 0) + (1 if has_measurements else 0) %}<div class="wide"><table class="overview" id="scans">
<thead><tr><th class="n">number</th><th>scan</th>{% if has_measurements %}<th>measured</th>{% endif %}<th>state</th>{% if has_device %}<th>verdict</th><th class="n">{{ judged_by }}</th>{% endif %}<th class="n">pull-off force</th>{% if has_half_space %}<th class="n">of the half-space</th>{% endif %}<th class="n">contact fraction</th><th class="n">contacts</th><th class="n">elastic / mixed / plastic</th><th class="n">rms height</th></tr></thead>
{% for row in table %}<tbody><tr><td class="n">{% if row.anchor %}<a href="#scan{{ row.number }}">{{ row.number }}</a>{% else %}{{ row.number }}{% endif %}</td><td class="path">{{ row.name }}</td>{% if has_measurements %}<td>{{ row.measured }}</td>{% endif %}
{%- if row.message %}<td colspan="{{ columns - (1 if has_measurements else 0) }}">not predicted: {{ row.message }}</td></tr>
{%- else %}<td>{{ row.status }}</td>{% if has_device %}<td class="{{ row.sticks }}">{{ row.releases }}</td><td class="n">{{ row.ratio }}</td>{% endif %}<td class="n">{{ row.pull_off }}</td>{% if has_half_space %}<td class="n">{{ row.half_space }}</td>{% endif %}<td class="n">{{ row.contact }}</td><td class="n">{{ row.contacts }}</td><td class="n">{{ row.regimes }}</td><td class="n">{{ row.rms }}</td></tr>
{%- if row.limits %}<tr class="limits"><td></td><td colspan="{{ columns + 1 }}">{{ row.limits }}</td></tr>{% endif %}{% endif %}</tbody>
{% endfor %}</table></div>
{% if bounded %}<p class="quiet">&ge; marks lower bounds: the search ended before the contacts stopped growing.</p>{% endif %}

{% if has_half_space %}<p class="quiet">Of the half-space: the whole surface solved as one elastic half-space; in brackets, how many times as large the prediction is.{% if has_device %} It has judged where the verdict says so.{% endif %}</p>{% endif %}

{% if trends %}<h2>Trends</h2>
<div class="picture trends"><img alt="Trends over the scans" src="{{ trends }}"></div>{% endif %}

{% for scan in scans %}<div class="scan" id="scan{{ scan.number }}">
<div class="head"><h2>{{ scan.number }}: {{ scan.name }}</h2>
{% if scan.origin %}<p class="origin">{{ scan.origin }}</p>{% endif %}
{% for warning in scan.warnings %}<p class="warning">{{ warning }}</p>{% endfor %}
{% if scan.verdict %}<p><span class="{{ scan.sticks }}">{{ scan.releases[0] | upper }}{{ scan.releases[1:] }}.</span> {{ scan.verdict }}</p>{% endif %}
{% if scan.flags %}<p class="warning">Outside the model's range: {{ scan.flags }}.</p>{% endif %}
<div class="picture maps"><img alt="Heights, contact map and cross-section" src="{{ scan.maps }}"></div></div>
<div class="figures">{% for label, value in scan.figures %}<div><span>{{ label }}</span><span>{{ value }}</span></div>{% endfor %}</div>
<div class="picture details"><img alt="Energy or force on the approach, forces, loads, plasticity" src="{{ scan.details }}"></div>
<h3>The surface after cleaning, by ISO 25178-2</h3>
<div class="picture surface"><img alt="Histogram of the heights, material ratio curve, spectrum" src="{{ scan.surface }}"></div>
<div class="figures">{% for label, value in scan.surface_figures %}<div><span>{{ label }}</span><span>{{ value }}</span></div>{% endfor %}</div>
{% if scan.cleaning %}<div class="cleaning"><h3>What each cleaning step did</h3>
<div class="beside"><div class="picture"><img alt="The surface after each cleaning step, and what the step changed" style="max-width: {{ scan.cleaning.width }}px" src="{{ scan.cleaning.image }}"></div>
<div class="wide"><table><tr><th></th><th class="n">rms height</th><th class="n">rms of the change</th><th class="n">pixels changed</th><th class="n">not measured</th><th class="n">pull-off force on this surface</th></tr>
{% for row in scan.cleaning.rows %}<tr><td>{{ row.words }}</td><td class="n">{{ row.rms }}</td><td class="n">{{ row.change }}</td><td class="n">{{ row.changed }}</td><td class="n">{{ row.missing }}</td><td class="n">{{ row.pull_off }}</td></tr>
{% endfor %}</table></div></div></div>{% endif %}
{% if scan.why_no_cleaning %}<p class="quiet">What each cleaning step did is not shown: {{ scan.why_no_cleaning }}</p>{% endif %}
{% if scan.half_space %}<h3>The whole surface as one elastic half-space</h3>
<p>{{ scan.half_space.words }}</p>
{% if scan.half_space.image %}<div class="picture"><img alt="Contacts of the asperity model and of the half-space, force over height" src="{{ scan.half_space.image }}"></div>{% endif %}
<div class="figures">{% for label, value in scan.half_space.figures %}<div><span>{{ label }}</span><span>{{ value }}</span></div>{% endfor %}</div>{% endif %}
</div>
{% endfor %}

<div class="appendix">
<h2>Appendix: how this was made</h2>
<h3>Inputs</h3>
<ul>{% for input in inputs %}<li class="path">{{ input }}</li>{% endfor %}</ul>
<h3>Versions</h3>
<p>{% for name, value in versions %}{{ name }} {{ value }}{% if not loop.last %}, {% endif %}{% endfor %}</p>
<h3>Model and sources</h3>
<ul>{% for source in sources %}<li>{{ source }}</li>{% endfor %}</ul>
{% if settings_name %}<h3>Settings</h3>
<p>All settings in effect, with their units, stand in <span class="path">{{ settings_name }}</span> beside this page.</p>{% endif %}
<div class="settings">{% if configuration_file %}<details><summary>Configuration as given: <span class="path">{{ configuration_name }}</span></summary>
<pre>{{ configuration_file }}</pre></details>{% endif %}
<details><summary>All settings in effect</summary>
<pre>{{ configuration }}</pre></details></div>
</div>
</body>
</html>
"""  # noqa: E501
