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
main{max-width:1180px;margin:0 auto;padding:24px}
h1{font-size:24px;margin:0 0 4px}h2{font-size:17px;margin:0 0 10px}
section{background:#fff;border:1px solid #deded8;border-radius:8px;padding:16px;margin:16px 0}
.verdict{display:inline-block;padding:2px 12px;border-radius:12px;color:#fff;font-weight:600}
.valid{background:#2c8a4b}.invalid{background:#c02a2a}
.two{display:grid;grid-template-columns:repeat(auto-fit,minmax(340px,1fr));gap:16px}
.two section{margin:0}img{max-width:100%;border:1px solid #e4e4de}
table{border-collapse:collapse;width:100%}td,th{padding:3px 10px 3px 0;text-align:left;border-bottom:1px solid #eee}
td:last-child,th:last-child{text-align:right;font-variant-numeric:tabular-nums;padding-right:0}
canvas{width:100%;height:560px;display:block;touch-action:none;cursor:grab;background:#fbfbfa;border:1px solid #e4e4de}
button{font:inherit;padding:4px 14px;border:1px solid #bbb;border-radius:6px;background:#fff;cursor:pointer;margin:0 6px 10px 0}
button.on{background:#24262b;color:#fff}
.scale{height:16px;background:linear-gradient(90deg,#365ca8,#62a8cc,#def0ce,#fcca68,#e8623a,#960a1e)}
.ticks{display:flex;justify-content:space-between;font-size:12px}
svg{width:100%;height:auto}svg text{font-size:11px;fill:#555}
p.note{color:#666;font-size:13px;margin:6px 0 0}
.stack{position:relative;display:inline-block;line-height:0;cursor:crosshair}
.stack canvas{position:absolute;inset:1px;width:calc(100% - 2px);height:calc(100% - 2px);background:none;border:0;pointer-events:none}
tr.chart{cursor:pointer}tr.chart:hover,tr.chart.on{background:#fff2dc}#chosen{font-weight:600;min-height:1.5em}
</style></head><body><main>
)html";

/// The view of the model; `@DATA@` is replaced by an object of base64 strings.
inline constexpr const char* report_view =
    R"html(<section><h2>The model</h2>
<div id="modes"></div><canvas id="view"></canvas><div id="chosen"></div>
<p class="note">Drag to turn, scroll or pinch to zoom, double-click to reset. Point at a chart, here or on the page, to see it on both.</p></section>
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
void main(){place=turn*(position-center);coordinates=uv;number=chart;vec3 p=place*zoom;
gl_Position=mode==6?vec4(uv*2.-1.,0.,1.):vec4(p.x/max(aspect,1.),p.y*min(aspect,1.),-place.z*0.3-nearer,1.);}`;
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
else if(mode==3){vec2 x=dFdx(coordinates),y=dFdy(coordinates);
base=heat(.5+.25*log2(max(abs(x.x*y.y-x.y*y.x),1e-30)/max(length(across),1e-30)/density));}
if(chosen>=0.&&abs(number-chosen)<.5)base=mix(base,vec3(1.,.55,.05),.55);
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
attribute("position",3,new Float32Array(bytes(data.positions)));attribute("uv",2,new Float32Array(bytes(data.uv)));
attribute("chart",1,new Float32Array(bytes(data.charts)));
const elements=text=>{const values=new Uint32Array(bytes(text)),buffer=gl.createBuffer();
gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER,buffer);gl.bufferData(gl.ELEMENT_ARRAY_BUFFER,values,gl.STATIC_DRAW);return{buffer,count:values.length};};
const triangles=elements(data.indices),seams=elements(data.seams);
const uniform=name=>gl.getUniformLocation(program,name);
const pictures=["page","stretch"].map(id=>{const texture=gl.createTexture(),image=document.getElementById(id);
const load=()=>{gl.bindTexture(gl.TEXTURE_2D,texture);gl.texImage2D(gl.TEXTURE_2D,0,gl.RGBA,gl.RGBA,gl.UNSIGNED_BYTE,image);
gl.generateMipmap(gl.TEXTURE_2D);gl.texParameteri(gl.TEXTURE_2D,gl.TEXTURE_MIN_FILTER,gl.LINEAR_MIPMAP_LINEAR);draw();};
if(image.complete)setTimeout(load);else image.onload=load;return texture;});
)html"
    R"html(let azimuth,elevation,zoom,center,mode=0,chosen=-1,showsSeams=true;
const reset=()=>{azimuth=-.5;elevation=.3;zoom=1;center=[0,0,0];};reset();
const pass=(kind,elements,shape,nearer)=>{gl.uniform1i(uniform("mode"),kind);gl.uniform1f(uniform("nearer"),nearer);
gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER,elements.buffer);gl.drawElements(shape,elements.count,gl.UNSIGNED_INT,0);};
function aim(w,h){
gl.viewport(0,0,w,h);gl.enable(gl.DEPTH_TEST);
const ca=Math.cos(azimuth),sa=Math.sin(azimuth),ce=Math.cos(elevation),se=Math.sin(elevation);
gl.uniformMatrix3fv(uniform("turn"),false,[ca,sa*se,-sa*ce,0,ce,se,sa,-ca*se,ca*ce]);
gl.uniform3fv(uniform("center"),center);gl.uniform1f(uniform("zoom"),zoom*.96);gl.uniform1f(uniform("aspect"),w/h);
gl.uniform1f(uniform("squares"),data.squares);gl.uniform1f(uniform("chosen"),chosen);gl.uniform1f(uniform("density"),data.density);}
function draw(){
const w=Math.round(canvas.clientWidth*devicePixelRatio),h=Math.round(canvas.clientHeight*devicePixelRatio);
if(canvas.width!==w||canvas.height!==h){canvas.width=w;canvas.height=h;}
aim(w,h);gl.clearColor(.984,.984,.98,1);gl.clear(gl.COLOR_BUFFER_BIT|gl.DEPTH_BUFFER_BIT);
gl.bindTexture(gl.TEXTURE_2D,pictures[mode===2?1:0]);
pass(mode===4?7:mode,triangles,gl.TRIANGLES,0);
if(showsSeams&&seams.count)pass(4,seams,gl.LINES,.002);}
// The numbers of charts, as another picture of the same size: bottom row first.
function numbers(kind,w,h,x,y,width,height){
const frame=gl.createFramebuffer(),colors=gl.createRenderbuffer(),depth=gl.createRenderbuffer();
gl.bindFramebuffer(gl.FRAMEBUFFER,frame);
[[colors,gl.RGBA8,gl.COLOR_ATTACHMENT0],[depth,gl.DEPTH_COMPONENT16,gl.DEPTH_ATTACHMENT]].forEach(([buffer,format,place])=>{
gl.bindRenderbuffer(gl.RENDERBUFFER,buffer);gl.renderbufferStorage(gl.RENDERBUFFER,format,w,h);
gl.framebufferRenderbuffer(gl.FRAMEBUFFER,place,gl.RENDERBUFFER,buffer);});
aim(w,h);gl.clearColor(0,0,0,0);gl.clear(gl.COLOR_BUFFER_BIT|gl.DEPTH_BUFFER_BIT);pass(kind,triangles,gl.TRIANGLES,0);
const pixels=new Uint8Array(4*width*height),result=new Int32Array(width*height);
gl.readPixels(x,y,width,height,gl.RGBA,gl.UNSIGNED_BYTE,pixels);
for(let i=0;i<result.length;++i)result[i]=pixels[4*i]+256*pixels[4*i+1]+65536*pixels[4*i+2]-1;
gl.bindFramebuffer(gl.FRAMEBUFFER,null);[colors,depth].forEach(b=>gl.deleteRenderbuffer(b));gl.deleteFramebuffer(frame);return result;}
const image=document.getElementById("page"),overlay=document.createElement("canvas"),stack=document.createElement("div"),side=1024;
let onPage=null;
const pageNumbers=()=>onPage||(onPage=numbers(6,side,side,0,0,side,side));
if(data.linked){stack.className="stack";image.replaceWith(stack);stack.append(image,overlay);overlay.width=overlay.height=side;}
function choose(chart){
if(chart===chosen)return;
chosen=chart;
document.querySelectorAll("tr.chart").forEach(row=>row.classList.toggle("on",Number(row.dataset.chart)===chart));
document.getElementById("chosen").textContent=chart<0?"":"chart "+chart+": "+data.about[chart];
if(data.linked){const context=overlay.getContext("2d"),mask=context.createImageData(side,side),map=pageNumbers();
if(chart>=0)for(let i=0;i<map.length;++i)if(map[i]===chart){
const k=4*((side-1-Math.floor(i/side))*side+i%side);mask.data.set([255,130,0,170],k);}
context.putImageData(mask,0,0);}
draw();}
stack.onpointermove=e=>{const r=image.getBoundingClientRect(),x=Math.floor((e.clientX-r.left)/r.width*side),y=side-1-Math.floor((e.clientY-r.top)/r.height*side);
if(x>=0&&y>=0&&x<side&&y<side)choose(pageNumbers()[y*side+x]);};
stack.onpointerleave=()=>choose(-1);
document.addEventListener("click",e=>{const row=e.target.closest("tr.chart");if(!row)return;
const[x,y,z,nx,ny,nz,radius]=JSON.parse(row.dataset.place);
center=[x,y,z];elevation=Math.asin(Math.max(-1,Math.min(1,ny)));azimuth=Math.atan2(-nx,nz);zoom=Math.max(2.5,Math.min(50,.8/radius));
chosen=-1;choose(Number(row.dataset.chart));canvas.scrollIntoView({block:"center"});});
["Checkerboard","Charts","Stretch","Density","Plain"].forEach((name,i)=>{const b=document.createElement("button");b.textContent=name;
b.className=i===mode?"on":"";b.onclick=()=>{mode=i;[...b.parentNode.children].forEach(o=>{if(o.id!=="seams")o.className=o===b?"on":"";});draw();};
document.getElementById("modes").append(b);});
const seamButton=document.createElement("button");seamButton.id="seams";seamButton.textContent="Seams";seamButton.className="on";
seamButton.onclick=()=>{showsSeams=!showsSeams;seamButton.className=showsSeams?"on":"";draw();};document.getElementById("modes").append(seamButton);
const pointers=new Map();let spread=0;
canvas.onpointerdown=e=>{pointers.set(e.pointerId,[e.clientX,e.clientY]);canvas.setPointerCapture(e.pointerId);spread=0;};
canvas.onpointerup=canvas.onpointercancel=e=>{pointers.delete(e.pointerId);spread=0;};
canvas.onpointermove=e=>{const before=pointers.get(e.pointerId);
if(!before){const r=canvas.getBoundingClientRect(),x=Math.floor((e.clientX-r.left)/r.width*canvas.width),y=canvas.height-1-Math.floor((e.clientY-r.top)/r.height*canvas.height);
choose(numbers(5,canvas.width,canvas.height,x,y,1,1)[0]);return;}
pointers.set(e.pointerId,[e.clientX,e.clientY]);
if(pointers.size===1){azimuth+=(e.clientX-before[0])*.008;
elevation=Math.max(-1.57,Math.min(1.57,elevation+(e.clientY-before[1])*.008));}
else{const[a,b]=[...pointers.values()],d=Math.hypot(a[0]-b[0],a[1]-b[1]);if(spread)zoom*=d/spread;spread=d;}draw();};
canvas.onpointerleave=()=>choose(-1);
canvas.onwheel=e=>{e.preventDefault();zoom=Math.max(.2,Math.min(200,zoom*Math.exp(-e.deltaY*.0015)));draw();};
canvas.ondblclick=()=>{reset();draw();};
addEventListener("resize",draw);draw();
})();
</script>
)html";

} // namespace Atlas::internal

#endif
