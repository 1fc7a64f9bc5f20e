#!/usr/bin/env python3
"""Makes a large elevation model of small ones, repeated side by side: a VRT, which takes no space.

usage: tools/repeat_dem.py SIZE OUTPUT.vrt DEM...

  SIZE     rows and columns of the result
  DEM      elevation models of one size, taken in turn; cells of 90 m, whatever theirs are

For trying what is larger than memory. Needs GDAL's command line (gdal-bin).
"""

import json
import os
import subprocess
import sys


def main():
    if len(sys.argv) < 4 or not sys.argv[1].isdigit():
        sys.exit(__doc__.strip())
    size, output, dems = int(sys.argv[1]), sys.argv[2], [os.path.abspath(dem) for dem in sys.argv[3:]]
    info = json.loads(subprocess.run(["gdalinfo", "-json", dems[0]], capture_output=True, check=True).stdout)
    columns, rows = info["size"]
    band = info["bands"][0]
    step_x, step_y = columns - 1, rows - 1  # tiles of survey data share their border
    sources = []
    for y in range(0, size, step_y):
        for x in range(0, size, step_x):
            dem = dems[len(sources) % len(dems)]
            width, height = min(columns, size - x), min(rows, size - y)
            sources.append(f"""<SimpleSource><SourceFilename relativeToVRT="0">{dem}</SourceFilename>
<SourceBand>1</SourceBand><SourceProperties RasterXSize="{columns}" RasterYSize="{rows}"
DataType="{band['type']}" BlockXSize="{band['block'][0]}" BlockYSize="{band['block'][1]}"/>
<SrcRect xOff="0" yOff="0" xSize="{width}" ySize="{height}"/>
<DstRect xOff="{x}" yOff="{y}" xSize="{width}" ySize="{height}"/></SimpleSource>""")
    with open(output, "w", encoding="utf-8") as vrt:
        vrt.write(f"""<VRTDataset rasterXSize="{size}" rasterYSize="{size}"><SRS>EPSG:32605</SRS>
<GeoTransform>0, 90, 0, 5400000, 0, -90</GeoTransform>
<VRTRasterBand dataType="{band['type']}" band="1"><NoDataValue>-32767</NoDataValue>
{chr(10).join(sources)}
</VRTRasterBand></VRTDataset>
""")


if __name__ == "__main__":
    main()
