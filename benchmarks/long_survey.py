#!/usr/bin/env python3
"""Writes a survey of any length, to measure what `stillwater map` needs for it.

    python3 benchmarks/long_survey.py 10000000 long.csv
    /usr/bin/time -v java -jar simulator/target/stillwater.jar map long.csv --value do_mg_l --out long-map

A boat mows a lake of 500 m by 400 m at 1 m/s, 10 readings a second, legs 10 m apart, over and over; the dissolved
oxygen is a smooth field read through a first-order lag of 10 s, rounded to 0.01 mg/L. Nothing is random.
"""
import math
import sys


def main():
    rows, path = int(sys.argv[1]), sys.argv[2]
    step, speed, tau = 0.1, 1.0, 10.0
    length, width, spacing = 400.0, 500.0, 10.0
    legs = int(width / spacing) + 1
    alpha = 1 - math.exp(-step / tau)
    leg, along, turn, reading = 0, 0.0, 0.0, 8.0
    with open(path, "w") as out:
        out.write("unix_time_s,lat_deg,lon_deg,temp_c,do_mg_l,depth_m\n")
        for row in range(rows):
            x = leg * spacing + turn
            y = along if leg % 2 == 0 else length - along
            if along < length:
                along += speed * step
            elif turn < spacing and leg + 1 < legs:
                turn += speed * step
            else:
                leg, along, turn = (leg + 1) % legs, 0.0, 0.0
            truth = 8 + math.sin(x / 90) * math.cos(y / 70) + 0.3 * math.sin(x / 23 + y / 31)
            reading += alpha * (truth - reading)
            out.write(
                "%.1f,%.7f,%.7f,%.2f,%.2f,%.2f\n"
                % (1.6e9 + row * step, 45.54 + y / 111320, -73.15 + x / 77950, 20 + truth / 10, reading, 0.5)
            )


if __name__ == "__main__":
    main()
