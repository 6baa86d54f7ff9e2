// Maps of values over places, such as slices of a workspace: small multiples with one cursor and one bar of colours.
import { useEffect, useMemo, useRef, useState } from "preact/hooks";
import { at, classColour, classes, classOf, countOf, indexOf, mapsOf, pathsOf, scaledOf, sizeOf, type Level, type Maps } from "./cells";
import type { Plot, Table } from "./data";
import { format } from "./units";
import { niceStep, ticks } from "./view";

const margin = { left: 50, right: 10, top: 4, bottom: 40 };
const gap = 16;
const [leastWidth, mostWidth, mostHeight] = [230, 640, 400]; // px

interface Place {
  i: number;
  j: number;
}

/** Size of each map: as many side by side as have room and fill the last row best. */
function layoutOf(maps: Maps, width: number): { scale: number; width: number; height: number } {
  const n = maps.levels.length;
  const most = Math.max(1, Math.min(n, Math.floor((width + gap) / (leastWidth + gap))));
  const columns = Math.ceil(n / Math.ceil(n / most));
  const room = Math.min(mostWidth, Math.floor((width - gap * (columns - 1)) / columns)) - margin.left - margin.right;
  const scale = Math.min(Math.max(room, 80) / sizeOf(maps.x), mostHeight / sizeOf(maps.y));
  return { scale, width: sizeOf(maps.x) * scale + margin.left + margin.right, height: sizeOf(maps.y) * scale + margin.top + margin.bottom };
}

const withUnit = (text: string, symbol: string) => (symbol ? `${text}${symbol === "°" ? "" : " "}${symbol}` : text);
const valueText = (maps: Maps, value: number | null | undefined) => (value == null ? "no value" : withUnit(format(value, 4), maps.valueUnit.symbol));

export function MapPlot({ plot, table }: { plot: Plot; table: Table }) {
  const box = useRef<HTMLDivElement>(null);
  const [room, setRoom] = useState(500);
  const [place, setPlace] = useState<Place | null>(null);
  const maps = useMemo(() => mapsOf(plot, table), [plot, table]);
  useEffect(() => {
    const measure = () => setRoom(box.current!.clientWidth || 500);
    measure();
    const observer = new ResizeObserver(measure);
    observer.observe(box.current!);
    return () => observer.disconnect();
  }, []);
  const layout = useMemo(() => maps && layoutOf(maps, room), [maps, room]);
  if (!maps || !layout) return <div ref={box}><p class="note">No values.</p></div>;
  const [nx, ny] = [countOf(maps.x), countOf(maps.y)];
  const show = (i: number, j: number) => setPlace({ i: Math.min(nx - 1, Math.max(0, i)), j: Math.min(ny - 1, Math.max(0, j)) });
  const onKey = (event: KeyboardEvent) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const step = event.shiftKey ? 10 : 1;
    const now = place ?? { i: Math.floor(nx / 2), j: Math.floor(ny / 2) };
    const moves: Record<string, [number, number]> = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, step], ArrowDown: [0, -step] };
    const move = moves[event.key];
    if (move) place ? show(now.i + move[0], now.j + move[1]) : show(now.i, now.j);
    else if (event.key === "Escape" && place) setPlace(null);
    else return;
    event.preventDefault();
    event.stopPropagation(); // elsewhere on the page these keys step through the motion
  };
  const alone = maps.levels.length === 1 && maps.levels[0].label === "";
  const values = place ? maps.levels.map((l) => l.find(place.i, place.j)?.value) : [];
  const where = place && [maps.x, maps.y].map((axis, k) => `${[maps.xLabel, maps.yLabel][k].replace(/ \([^()]*\)$/, "")} ${withUnit(format(at(axis, k ? place.j : place.i), 5), maps.unit.symbol)}`).join(", ");
  const range = (l: Level) => {
    const known = l.cells.flatMap((c) => (c.value === null ? [] : [c.value]));
    const [low, high] = known.reduce(([a, b], v) => [Math.min(a, v), Math.max(b, v)], [Infinity, -Infinity]);
    return known.length ? `${format(low, 4)} to ${format(high, 4)}` : "no value";
  };
  return (
    <>
      <div class={`map${alone ? "" : " several"}`} ref={box} tabIndex={0} role="group" aria-label={`${plot.title}: map of ${maps.valueLabel}; the arrow keys read its values`}
        onKeyDown={onKey} onPointerLeave={(e) => e.pointerType === "mouse" && setPlace(null)}>
        {maps.levels.map((level, k) => (
          <figure style={{ width: `${layout.width}px` }}>
            {!alone && <figcaption>{level.label}{place && <b>{valueText(maps, values[k])}</b>}</figcaption>}
            <Panel maps={maps} level={level} layout={layout} place={place} show={show} label={`${level.label || plot.title}: ${range(level)}, equal axes`} />
          </figure>
        ))}
      </div>
      <Bar maps={maps} marks={values.flatMap((v) => (v == null ? [] : [v]))} />
      <p class="note read" aria-live="polite">{where
        ? <>{where}: <b>{maps.levels.map((l, k) => (alone ? valueText(maps, values[k]) : `${valueText(maps, values[k])} (${l.label})`)).join(", ")}</b></>
        : <span class="screen-only">Point at a place to read its value{alone ? "" : " in every map"}.</span>}</p>
    </>
  );
}

function Panel({ maps, level, layout, place, show, label }: {
  maps: Maps; level: Level; layout: { scale: number; width: number; height: number }; place: Place | null; show: (i: number, j: number) => void; label: string;
}) {
  const { scale, width, height } = layout;
  const paths = useMemo(() => pathsOf(maps, level, scale), [maps, level, scale]);
  const [left, bottom] = [maps.x.low - maps.x.pitch / 2, maps.y.low - maps.y.pitch / 2];
  const x = (v: number) => margin.left + (v - left) * scale;
  const y = (v: number) => height - margin.bottom - (v - bottom) * scale;
  const step = niceStep(110 / scale); // 44 px or more, since steps grow by 2.5 at most
  const named = (v: number) => format(Math.abs(v) < step * 1e-6 ? 0 : v, 6);
  const [w, h] = [maps.x.pitch * scale, maps.y.pitch * scale];
  const read = (event: PointerEvent) => {
    const box = (event.currentTarget as Element).getBoundingClientRect();
    const zoom = width / (box.width || width);
    const [px, py] = [(event.clientX - box.left) * zoom, (event.clientY - box.top) * zoom];
    show(indexOf(maps.x, left + (px - margin.left) / scale), indexOf(maps.y, bottom + (height - margin.bottom - py) / scale));
  };
  return (
    <svg viewBox={`0 0 ${width.toFixed(1)} ${height.toFixed(1)}`} role="img" aria-label={label} onPointerMove={read} onPointerDown={read}>
      <g class="cells" transform={`translate(${margin.left},${margin.top})`} shape-rendering="crispEdges">
        {paths.map((d, k) => d && <path d={d} class={k < classes ? undefined : "none"} fill={k < classes ? classColour(k) : undefined} />)}
      </g>
      <g class="axes">
        <path d={`M${margin.left} ${margin.top}H${width - margin.right}V${height - margin.bottom}H${margin.left}z${ticks(left, left + sizeOf(maps.x), step).map((t) => `M${x(t).toFixed(1)} ${height - margin.bottom}v4`).join("")}${ticks(bottom, bottom + sizeOf(maps.y), step).map((t) => `M${margin.left} ${y(t).toFixed(1)}h-4`).join("")}`} />
        {ticks(left, left + sizeOf(maps.x), step).map((t) => <text x={x(t)} y={height - margin.bottom + 16} text-anchor="middle">{named(t)}</text>)}
        {ticks(bottom, bottom + sizeOf(maps.y), step).map((t) => <text x={margin.left - 7} y={y(t) + 4} text-anchor="end">{named(t)}</text>)}
        <text class="name" x={(margin.left + width - margin.right) / 2} y={height - 6} text-anchor="middle">{maps.xLabel}</text>
        <text class="name" transform={`translate(11,${(height - margin.bottom) / 2}) rotate(-90)`} text-anchor="middle">{maps.yLabel}</text>
      </g>
      {place && (
        <g class="at" transform={`translate(${x(at(maps.x, place.i)).toFixed(2)},${y(at(maps.y, place.j)).toFixed(2)})`}>
          {["halo", "line"].map((name) => <rect class={name} x={-w / 2 - 1} y={-h / 2 - 1} width={w + 2} height={h + 2} />)}
        </g>
      )}
    </svg>
  );
}

/** The one scale of colours, with the values that are read marked on it. */
function Bar({ maps, marks }: { maps: Maps; marks: number[] }) {
  const [width, left, height] = [420, 12, 12];
  const length = maps.missing ? 300 : width - 2 * left;
  const span = maps.high - maps.low;
  const share = (scaled: number) => (span > 0 ? (scaled - maps.low) / span : 0.5);
  const px = (scaled: number) => left + length * share(scaled);
  const step = niceStep(span / 4);
  const inner = span > 0 ? ticks(maps.low, maps.high, maps.logarithmic ? Math.max(1, step) : step).filter((v) => share(v) > 0.16 && share(v) < 0.84) : [];
  const text = (v: number, digits: number) => format(maps.logarithmic ? 10 ** v : v, digits);
  return (
    <svg class="colours" viewBox={`0 0 ${width} 58`} role="img" aria-label={`Colours from ${text(maps.low, 3)} (dark) to ${text(maps.high, 3)} (light): ${maps.valueLabel}`}>
      <g shape-rendering="crispEdges">
        {Array.from({ length: classes }, (_, k) => <rect x={left + (k * length) / classes} y={8} width={length / classes} height={height} fill={classColour(span > 0 ? k : classOf(0, 0, 0))} />)}
        {maps.missing && <rect class="none" x={left + length + 18} y={8} width={20} height={height} />}
      </g>
      {marks.map((v) => <path class="mark-at" d={`M${px(scaledOf(maps, v)).toFixed(1)} 8l-4 -7h8z`} />)}
      {span > 0 ? [maps.low, maps.high].map((v) => <text x={px(v)} y={34} text-anchor={v === maps.low ? "start" : "end"}>{text(v, 3)}</text>) : <text x={px(maps.low)} y={34} text-anchor="middle">{text(maps.low, 6)}</text>}
      {inner.map((v) => <text x={px(v)} y={34} text-anchor="middle">{text(v, 5)}</text>)}
      {maps.missing && <text x={left + length + 42} y={18}>no value</text>}
      <text class="name" x={left + length / 2} y={52} text-anchor="middle">{maps.valueLabel}</text>
    </svg>
  );
}
