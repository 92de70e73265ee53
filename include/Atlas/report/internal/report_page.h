// SPDX-License-Identifier: MIT
#ifndef ATLAS_REPORT_INTERNAL_REPORT_PAGE_H
#define ATLAS_REPORT_INTERNAL_REPORT_PAGE_H

namespace Atlas::internal {

/// The head of the page; `@TITLE@` is replaced.
inline constexpr const char* report_head = R"html(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>@TITLE@ &ndash; texture atlas</title>
<style>
body{font:15px/1.5 system-ui,sans-serif;margin:0;color:#24262b;background:#f4f4f1}
main{max-width:1400px;margin:0 auto;padding:20px 24px}
h1{font-size:24px;margin:0 0 4px}h2{font-size:17px;margin:0 0 10px}
section{background:#fff;border:1px solid #deded8;border-radius:8px;padding:16px;margin:16px 0}
.verdict{display:inline-block;padding:2px 12px;border-radius:12px;color:#fff;font-weight:600}
.valid{background:#2c8a4b}.invalid{background:#c02a2a}
.cards{display:grid;grid-template-columns:repeat(auto-fit,minmax(150px,1fr));gap:12px;margin:16px 0 0}
.cards div{background:#fff;border:1px solid #deded8;border-radius:8px;padding:10px 14px}
.cards strong{display:block;font-size:21px;font-variant-numeric:tabular-nums}.cards span{color:#666;font-size:13px}
.two{display:grid;grid-template-columns:repeat(auto-fit,minmax(420px,1fr));gap:16px;align-items:start}
.two section{margin:0;height:100%;box-sizing:border-box}img{max-width:100%;border:1px solid #e4e4de;box-sizing:border-box}
table{border-collapse:collapse;width:100%}td,th{padding:3px 10px 3px 0;text-align:left;border-bottom:1px solid #eee}
th{font-weight:600;color:#555}td.number,th.number{text-align:right;font-variant-numeric:tabular-nums;padding-right:32px}
.figures td:last-child{text-align:right;font-variant-numeric:tabular-nums;padding-right:0}
#view{width:100%;aspect-ratio:1;max-height:680px;display:block;touch-action:none;cursor:grab;background:#fbfbfa;border:1px solid #e4e4de;box-sizing:border-box}
#modes{display:flex;flex-wrap:wrap;gap:6px;margin:0 0 12px}#modes i{flex:1}
button{font:inherit;padding:4px 14px;border:1px solid #bbb;border-radius:6px;background:#fff;cursor:pointer}
button.on{background:#24262b;color:#fff}
.legend{max-width:420px;margin:10px 0 0;visibility:hidden}.legend.on{visibility:visible}
.scale{height:12px;background:linear-gradient(90deg,#365ca8,#62a8cc,#def0ce,#fcca68,#e8623a,#960a1e)}
.ticks{display:flex;justify-content:space-between;font-size:12px}
svg{width:100%;height:auto}svg text{font-size:11px;fill:#555}
p.note{color:#666;font-size:13px;margin:6px 0 0}
.stack{position:relative;line-height:0;cursor:crosshair;text-align:center}
.stack img{max-height:680px}
.stack canvas{position:absolute;pointer-events:none}
.stack img.off{display:none}
.ring{position:absolute;width:44px;height:44px;margin:-25px 0 0 -25px;border:3px solid #ff7a00;border-radius:50%;box-shadow:0 0 0 2px #fff,inset 0 0 0 2px #fff;pointer-events:none;display:none}
.ring.on{display:block}.model{position:relative}
tr.chart{cursor:pointer}tr.chart:hover,tr.chart.on{background:#fff2dc}#chosen{font-weight:600;min-height:1.5em;margin-top:8px}
@media(max-width:520px){main{padding:10px}.two{grid-template-columns:minmax(0,1fr)}section{padding:10px;overflow-x:auto}table{font-size:13px}td.number,th.number{padding-right:10px}}
</style></head><body><main>
)html";

/// The view of the model beside the page; `@PAGE@` is replaced by the two pictures of the page, `@DATA@` by
/// an object of base64 strings.
inline constexpr const char* report_view =
    R"html(<section><div id="modes"></div><div class="two">
<div class="model"><canvas id="view"></canvas><div class="ring" style="left:50%;top:50%"></div></div>
<div><div class="stack">@PAGE@<canvas id="overlay"></canvas><div class="ring"></div></div></div></div>
<div class="legend" id="legend"><div class="scale"></div><div class="ticks"></div></div>
<div id="chosen"></div>
<p class="note">Drag to turn, scroll or pinch to zoom, double-click to reset. Point at a chart, on the model or on the page, to see it on both; click it on the page to look at it.</p></section>
<script>
"use strict";
const data=@DATA@;
)html"
    R"html((function(){
const canvas=document.getElementById("view"),gl=canvas.getContext("webgl2",{antialias:true,preserveDrawingBuffer:true});
if(!gl){canvas.replaceWith("This browser has no WebGL 2.");return;}
const bytes=s=>Uint8Array.from(atob(s),c=>c.charCodeAt(0)).buffer;
const vertexSource=`#version 300 es
in vec3 position;in vec2 uv;in float chart;out vec3 place;out vec2 coordinates;flat out float number;
uniform mat3 turn;uniform vec3 center;uniform float zoom,aspect,nearer;uniform highp int mode;
void main(){place=mode==8?position:turn*(position-center);coordinates=uv;number=chart;vec3 p=place*zoom;
gl_Position=mode==6||mode==8?vec4(uv*2.-1.,0.,1.):vec4(p.x/max(aspect,1.),p.y*min(aspect,1.),-place.z*0.3-nearer,1.);}`;
const fragmentSource=`#version 300 es
precision highp float;in vec3 place;in vec2 coordinates;flat in float number;out vec4 color;
uniform sampler2D picture;uniform highp int mode;uniform float squares,chosen,density;
vec3 heat(float t){vec3 c[6]=vec3[](vec3(54.,92.,168.),vec3(98.,168.,204.),vec3(222.,240.,206.),vec3(252.,202.,104.),vec3(232.,98.,58.),vec3(150.,10.,30.));
float x=clamp(t,0.,1.)*4.999;int i=int(x);return mix(c[i],c[i+1],x-float(i))/255.;}
void main(){vec3 across=cross(dFdx(place),dFdy(place)),normal=normalize(across);
float light=.42+.5*max(dot(normal,normalize(vec3(-.35,.55,.9))),0.)+.12*max(normal.z,0.);
vec3 base=vec3(.82);
if(mode==4){color=vec4(.08,.08,.1,1.);return;}
if(mode==5||mode==6){float n=number+1.;color=vec4(mod(n,256.),mod(floor(n/256.),256.),floor(n/65536.),255.)/255.;return;}
if(mode==0){vec2 f=coordinates*squares,w=max(fwidth(f),1e-6),s=abs(fract(f*.5)-.5)*2.;
vec2 k=clamp((s-.5)/w+.5,0.,1.);float check=mix(k.x,1.-k.x,k.y);
float keep=clamp(1.5-max(w.x,w.y),0.,1.);check=mix(.5,check,keep);
vec3 hue=.5+.5*cos(6.2832*(vec3(0.,.33,.67)+.45*(coordinates.x+1.-coordinates.y)));
base=mix(mix(vec3(.35),hue,.45),mix(vec3(1.),hue,.12),check);}
else if(mode<3)base=texture(picture,vec2(coordinates.x,1.-coordinates.y)).rgb;
else if(mode==3||mode==8){vec2 x=dFdx(coordinates),y=dFdy(coordinates);
base=heat(.5+.25*log2(max(abs(x.x*y.y-x.y*y.x),1e-30)/max(length(across),1e-30)/density));}
if(mode==8){color=vec4(base,1.);return;}
if(chosen>=0.&&abs(number-chosen)<.5)base=mix(base,vec3(1.,.55,.05),mode==2||mode==3?.2:.55);
color=vec4(base*light,1.);}`;
const compile=(type,source)=>{const s=gl.createShader(type);gl.shaderSource(s,source);gl.compileShader(s);
if(!gl.getShaderParameter(s,gl.COMPILE_STATUS))throw gl.getShaderInfoLog(s);return s;};
const program=gl.createProgram();
gl.attachShader(program,compile(gl.VERTEX_SHADER,vertexSource));gl.attachShader(program,compile(gl.FRAGMENT_SHADER,fragmentSource));
gl.linkProgram(program);
if(!gl.getProgramParameter(program,gl.LINK_STATUS))throw gl.getProgramInfoLog(program);
gl.useProgram(program);
const attribute=(name,size,values)=>{const place=gl.getAttribLocation(program,name);if(place<0)return;
gl.bindBuffer(gl.ARRAY_BUFFER,gl.createBuffer());gl.bufferData(gl.ARRAY_BUFFER,values,gl.STATIC_DRAW);
gl.enableVertexAttribArray(place);gl.vertexAttribPointer(place,size,gl.FLOAT,false,0,0);};
const positions=new Float32Array(bytes(data.positions)),uvs=new Float32Array(bytes(data.uv)),charts=new Float32Array(bytes(data.charts));
attribute("position",3,positions);attribute("uv",2,uvs);attribute("chart",1,charts);
const buffered=values=>{const buffer=gl.createBuffer();
gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER,buffer);gl.bufferData(gl.ELEMENT_ARRAY_BUFFER,values,gl.STATIC_DRAW);return{buffer,count:values.length,values};};
const elements=text=>buffered(new Uint32Array(bytes(text)));
const triangles=elements(data.indices),seams=elements(data.seams);
const uniforms={},uniform=name=>uniforms[name]||(uniforms[name]=gl.getUniformLocation(program,name));
const images=["page","stretch"].map(id=>document.getElementById(id));
const pictures=images.map(image=>{const texture=gl.createTexture();
const load=()=>{gl.bindTexture(gl.TEXTURE_2D,texture);gl.texImage2D(gl.TEXTURE_2D,0,gl.RGBA,gl.RGBA,gl.UNSIGNED_BYTE,image);
gl.generateMipmap(gl.TEXTURE_2D);gl.texParameteri(gl.TEXTURE_2D,gl.TEXTURE_MIN_FILTER,gl.LINEAR_MIPMAP_LINEAR);draw();};
image.decode().then(load);return texture;});
)html"
    R"html(let azimuth,elevation,zoom,center,mode=0,chosen=-1,showsSeams=true,waits=false,moves=false,isSlow=false,last=0,rough=null;
const reset=()=>{azimuth=-.5;elevation=.3;zoom=1;center=[0,0,0];};reset();
const pass=(kind,elements,shape,nearer)=>{gl.uniform1i(uniform("mode"),kind);gl.uniform1f(uniform("nearer"),nearer);
gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER,elements.buffer);gl.drawElements(shape,elements.count,gl.UNSIGNED_INT,0);};
function aim(w,h){
gl.viewport(0,0,w,h);gl.enable(gl.DEPTH_TEST);
const ca=Math.cos(azimuth),sa=Math.sin(azimuth),ce=Math.cos(elevation),se=Math.sin(elevation);
gl.uniformMatrix3fv(uniform("turn"),false,[ca,sa*se,-sa*ce,0,ce,se,sa,-ca*se,ca*ce]);
gl.uniform3fv(uniform("center"),center);gl.uniform1f(uniform("zoom"),zoom*.96);gl.uniform1f(uniform("aspect"),w/h);
gl.uniform1f(uniform("squares"),data.squares);gl.uniform1f(uniform("chosen"),chosen);gl.uniform1f(uniform("density"),data.density);}
// A large model turns as a rough copy where the computer cannot draw all of it in time: one vertex for each cell of a grid and each chart.
function roughTriangles(){
if(rough)return rough;
const n=96,first=new Map(),own=new Uint32Array(charts.length),few=[],cell=(v,k)=>Math.floor((positions[3*v+k]+1)*n/2)+1;
for(let v=0;v<charts.length;++v){const key=((cell(v,0)*128+cell(v,1))*128+cell(v,2))*16777216+charts[v]+1;
let f=first.get(key);if(f===undefined){f=v;first.set(key,v);}own[v]=f;}
for(let h=0;h<triangles.count;h+=3){const a=own[triangles.values[h]],b=own[triangles.values[h+1]],c=own[triangles.values[h+2]];
if(a!==b&&b!==c&&c!==a)few.push(a,b,c);}
return rough=buffered(new Uint32Array(few));}
const shape=()=>moves&&isSlow?roughTriangles():triangles;
function draw(){
const w=Math.round(canvas.clientWidth*devicePixelRatio),h=Math.round(canvas.clientHeight*devicePixelRatio);
if(canvas.width!==w||canvas.height!==h){canvas.width=w;canvas.height=h;}
aim(w,h);gl.clearColor(.984,.984,.98,1);gl.clear(gl.COLOR_BUFFER_BIT|gl.DEPTH_BUFFER_BIT);
gl.bindTexture(gl.TEXTURE_2D,pictures[mode===2?1:0]);
pass(mode===4?7:mode,shape(),gl.TRIANGLES,0);
if(showsSeams&&seams.count&&!(moves&&isSlow))pass(4,seams,gl.LINES,.002);}
// However many events there are, one picture a frame is drawn.
const redraw=()=>{if(waits)return;waits=true;requestAnimationFrame(now=>{waits=false;
if(moves&&triangles.count>data.many&&last&&now-last>120)isSlow=true;
last=moves?now:0;draw();});};
let rest=0;
const settle=()=>{clearTimeout(rest);rest=setTimeout(()=>{if(pointers.size||!moves)return;moves=false;redraw();},250);};
const move=()=>{moves=true;settle();redraw();};
// A picture beside the one that is seen. The numbers of charts on the model are drawn anew only when the view has changed.
function target(w,h){
const frame=gl.createFramebuffer(),colors=gl.createRenderbuffer(),depth=gl.createRenderbuffer();
gl.bindFramebuffer(gl.FRAMEBUFFER,frame);
[[colors,gl.RGBA8,gl.COLOR_ATTACHMENT0],[depth,gl.DEPTH_COMPONENT16,gl.DEPTH_ATTACHMENT]].forEach(([buffer,format,place])=>{
gl.bindRenderbuffer(gl.RENDERBUFFER,buffer);gl.renderbufferStorage(gl.RENDERBUFFER,format,w,h);
gl.framebufferRenderbuffer(gl.FRAMEBUFFER,place,gl.RENDERBUFFER,buffer);});
return{frame,free(){[colors,depth].forEach(b=>gl.deleteRenderbuffer(b));gl.deleteFramebuffer(frame);}};}
function fill(kind,w,h){aim(w,h);gl.clearColor(0,0,0,0);gl.clear(gl.COLOR_BUFFER_BIT|gl.DEPTH_BUFFER_BIT);
pass(kind,kind===5&&isSlow?roughTriangles():triangles,gl.TRIANGLES,0);}
function read(x,y,w,h){const pixels=new Uint8Array(4*w*h);gl.readPixels(x,y,w,h,gl.RGBA,gl.UNSIGNED_BYTE,pixels);
gl.bindFramebuffer(gl.FRAMEBUFFER,null);return pixels;}
const chartOf=(pixels,i)=>pixels[4*i]+256*pixels[4*i+1]+65536*pixels[4*i+2]-1;
let seen=null,seenKey="";
function chartAt(x,y){
const w=canvas.width,h=canvas.height,key=[w,h,azimuth,elevation,zoom,...center].join();
if(key!==seenKey){if(seen)seen.free();seen=target(w,h);fill(5,w,h);seenKey=key;}
gl.bindFramebuffer(gl.FRAMEBUFFER,seen.frame);return chartOf(read(x,y,1,1),0);}
const stack=document.querySelector(".stack"),overlay=document.getElementById("overlay"),side=1024,onPages={};
overlay.width=overlay.height=side;
const onPage=kind=>onPages[kind]||(onPages[kind]=(()=>{const t=target(side,side);fill(kind,side,side);const pixels=read(0,0,side,side);t.free();return pixels;})());
const shownImage=()=>images[mode===2?1:0];
function placeOverlay(){const r=shownImage().getBoundingClientRect(),s=stack.getBoundingClientRect();
Object.assign(overlay.style,{left:r.left-s.left+"px",top:r.top-s.top+"px",width:r.width+"px",height:r.height+"px"});}
function drawOverlay(){
placeOverlay();
const context=overlay.getContext("2d"),mask=context.createImageData(side,side),shows=mode===3?onPage(8):null;
const numbers=data.linked&&chosen>=0?onPage(6):null;
if(shows||numbers)for(let i=0;i<side*side;++i){
const k=4*((side-1-Math.floor(i/side))*side+i%side);
if(shows)mask.data.set(shows[4*i+3]?shows.subarray(4*i,4*i+4):[251,251,250,255],k);
if(numbers&&chartOf(numbers,i)===chosen){if(mode===3)for(let c=0;c<3;++c)mask.data[k+c]=.75*mask.data[k+c]+.25*[255,130,0][c];
else mask.data.set([255,130,0,mode===2?60:170],k);}}
context.putImageData(mask,0,0);}
function choose(chart){
if(chart===chosen)return;
chosen=chart;
document.querySelectorAll("tr.chart").forEach(row=>row.classList.toggle("on",Number(row.dataset.chart)===chart));
document.getElementById("chosen").textContent=chart<0?"":"chart "+chart+": "+data.about[chart];
drawOverlay();redraw();}
const rings=[...document.querySelectorAll(".ring")];
const hideRings=()=>rings.forEach(ring=>ring.classList.remove("on"));
// A ring around a place of a chart: in the middle of the view, and on the page at the nearest vertex.
function showRings(place,chart){
let nearest=-1,least=Infinity;
for(let v=0;v<charts.length;++v)if(charts[v]===chart){
const d=Math.hypot(positions[3*v]-place[0],positions[3*v+1]-place[1],positions[3*v+2]-place[2]);if(d<least){least=d;nearest=v;}}
rings[0].classList.add("on");
if(nearest<0)return;
placeOverlay();
rings[1].style.left=overlay.offsetLeft+uvs[2*nearest]*overlay.offsetWidth+"px";
rings[1].style.top=overlay.offsetTop+(1-uvs[2*nearest+1])*overlay.offsetHeight+"px";rings[1].classList.add("on");}
function look(place,normal,radius){hideRings();center=place;elevation=Math.asin(Math.max(-1,Math.min(1,normal[1])));azimuth=Math.atan2(-normal[0],normal[2]);
zoom=Math.max(1,Math.min(50,.8/radius));}
)html"
    R"html(// The middle of a chart, the direction that it faces, and its radius.
function lookAtChart(chart){
const middle=[0,0,0],normal=[0,0,0];let count=0,radius=0;
const of=(h,k)=>positions[3*triangles.values[h]+k];
for(let h=0;h<triangles.count;h+=3){if(charts[triangles.values[h]]!==chart)continue;
for(let k=0;k<3;++k){const a=(k+1)%3,b=(k+2)%3;
normal[k]+=(of(h+1,a)-of(h,a))*(of(h+2,b)-of(h,b))-(of(h+1,b)-of(h,b))*(of(h+2,a)-of(h,a));
middle[k]+=of(h,k)+of(h+1,k)+of(h+2,k);}
count+=3;}
if(!count)return;
for(let k=0;k<3;++k)middle[k]/=count;
for(let v=0;v<charts.length;++v)if(charts[v]===chart)radius=Math.max(radius,Math.hypot(...[0,1,2].map(k=>positions[3*v+k]-middle[k])));
const length=Math.hypot(...normal)||1;look(middle,normal.map(x=>x/length),Math.max(radius,1e-3));}
const chartOnPage=e=>{const r=shownImage().getBoundingClientRect(),x=Math.floor((e.clientX-r.left)/r.width*side),y=side-1-Math.floor((e.clientY-r.top)/r.height*side);
return data.linked&&x>=0&&y>=0&&x<side&&y<side?chartOf(onPage(6),y*side+x):-1;};
stack.onpointermove=e=>choose(chartOnPage(e));
stack.onpointerleave=()=>choose(-1);
stack.onclick=e=>{const chart=chartOnPage(e);if(chart>=0){lookAtChart(chart);redraw();}};
document.addEventListener("click",e=>{const row=e.target.closest("tr.chart");if(!row)return;
const[x,y,z,nx,ny,nz,radius]=JSON.parse(row.dataset.place);
look([x,y,z],[nx,ny,nz],radius/2.5);
chosen=-1;choose(Number(row.dataset.chart));showRings([x,y,z],Number(row.dataset.chart));canvas.scrollIntoView({block:"center"});});
const toolbar=document.getElementById("modes"),legend=document.getElementById("legend");
const ticks={2:["1 (isometric)","1.41","2 and more"],3:["1/4","1: the mean density of area","4"]};
function setMode(i){mode=i;
[...toolbar.querySelectorAll("button.mode")].forEach((b,k)=>b.classList.toggle("on",k===i));
images.forEach((image,k)=>image.classList.toggle("off",k!==(i===2?1:0)));
legend.classList.toggle("on",i in ticks);
legend.querySelector(".ticks").replaceChildren(...(ticks[i]||[]).map(t=>{const s=document.createElement("span");s.textContent=t;return s;}));
drawOverlay();redraw();}
const button=(name,kind,act)=>{const b=document.createElement("button");b.textContent=name;b.className=kind;b.onclick=()=>act(b);toolbar.append(b);return b;};
["Checkerboard","Charts","Stretch","Density","Plain"].forEach((name,i)=>button(name,"mode",()=>setMode(i)));
toolbar.append(document.createElement("i"));
button("Seams","on",b=>{showsSeams=!showsSeams;b.classList.toggle("on",showsSeams);redraw();}).id="seams";
button("Whole model","",()=>{hideRings();reset();redraw();}).id="whole";
const pointers=new Map();let spread=0;
canvas.onpointerdown=e=>{pointers.set(e.pointerId,[e.clientX,e.clientY]);canvas.setPointerCapture(e.pointerId);spread=0;};
canvas.onpointerup=canvas.onpointercancel=e=>{pointers.delete(e.pointerId);spread=0;settle();};
canvas.onpointermove=e=>{const before=pointers.get(e.pointerId);
if(!before){const r=canvas.getBoundingClientRect(),x=Math.floor((e.clientX-r.left)/r.width*canvas.width),y=canvas.height-1-Math.floor((e.clientY-r.top)/r.height*canvas.height);
choose(data.linked?chartAt(x,y):-1);return;}
pointers.set(e.pointerId,[e.clientX,e.clientY]);hideRings();
if(pointers.size===1){azimuth+=(e.clientX-before[0])*.008;
elevation=Math.max(-1.57,Math.min(1.57,elevation+(e.clientY-before[1])*.008));}
else{const[a,b]=[...pointers.values()],d=Math.hypot(a[0]-b[0],a[1]-b[1]);if(spread)zoom*=d/spread;spread=d;}move();};
canvas.onpointerleave=()=>choose(-1);
canvas.onwheel=e=>{e.preventDefault();hideRings();zoom=Math.max(.2,Math.min(200,zoom*Math.exp(-e.deltaY*.0015)));move();};
canvas.ondblclick=()=>{hideRings();reset();redraw();};
addEventListener("resize",()=>{hideRings();drawOverlay();redraw();});setMode(0);
})();
</script>
)html";

} // namespace Atlas::internal

#endif
